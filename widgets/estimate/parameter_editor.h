// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QWidget>

namespace episcope {

/// Edits one parameter. The kind of editor follows the type of the default value: check box, slider
/// with spin box (powers where the description says so), combo, interval-or-auto, text.
class ParameterEditor : public QWidget {
  Q_OBJECT

 public:
  [[nodiscard]] virtual ParameterValue value() const = 0;
  /// Clamped to the domain. A value of another type is ignored. Does not emit.
  virtual void setValue(const ParameterValue& value) = 0;

 signals:
  /// The user changed the value.
  void edited();

 protected:
  using QWidget::QWidget;
};

/// Object names: "<key>" for the editor, "<key>.slider", "<key>.spin", "<key>.check",
/// "<key>.combo", "<key>.auto", "<key>.found", "<key>.min", "<key>.max", "<key>.text" for its
/// controls.
[[nodiscard]] ParameterEditor* make_parameter_editor(const ParameterDescription& description,
                                                     QWidget* parent);

}  // namespace episcope
