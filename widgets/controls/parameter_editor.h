// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QWidget>

#include <optional>

namespace episcope {

/// What is known of a range that may be left to the program, px per view step.
struct RangeHints {
  bool is_open = false;                ///< Whether there is a light field that it is known of.
  std::optional<Interval> promised{};  ///< By its files; without, automatic ranges are found.
  std::optional<Interval> found{};     ///< From its images; empty = not yet.
  friend bool operator==(const RangeHints&, const RangeHints&) = default;
};

/// Edits one parameter. The editor follows the type of the default value: check box, slider with
/// spin box, combo box, a choice of where an interval comes from, text.
class ParameterEditor : public QWidget {
  Q_OBJECT

 public:
  [[nodiscard]] virtual ParameterValue value() const = 0;
  /// Sets a value, clamped to the domain; ignores other types. Does not emit.
  virtual void setValue(const ParameterValue& value) = 0;
  /// Names the ranges that an interval would be; nothing to other types. Does not emit.
  virtual void setRangeHints(const RangeHints& /*hints*/) {}

 signals:
  /// The user changed the value.
  void edited();

 protected:
  using QWidget::QWidget;
};

/// Object names: "<key>" for the editor, "<key>.slider", "<key>.spin", "<key>.check",
/// "<key>.combo", "<key>.source", "<key>.min", "<key>.max", "<key>.auto", "<key>.v", "<key>.u",
/// "<key>.text" for its controls.
[[nodiscard]] ParameterEditor* make_parameter_editor(const ParameterDescription& description,
                                                     QWidget* parent);

}  // namespace episcope
