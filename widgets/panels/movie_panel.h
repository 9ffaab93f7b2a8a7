// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/movie.h"

#include <QCheckBox>
#include <QWidget>

#include <set>

class QComboBox;
class QFormLayout;
class QSpinBox;

namespace episcope {

class NumberSpin;

/// Kind, camera path, duration and size of a movie. Disables rows that its kind does not use.
/// Setters never emit.
class MoviePanel : public QWidget {
  Q_OBJECT

 public:
  explicit MoviePanel(QWidget* parent = nullptr);

  /// Available kinds; at least the parallax.
  void setAvailable(const std::set<render::MovieKind>& kinds);
  /// Whether there is an overlay to include.
  void setOverlayAvailable(bool is_available);
  void setFocusRange(Interval range_px);
  [[nodiscard]] render::MovieChoice choice() const;
  [[nodiscard]] bool showsOverlay() const { return overlay_->isEnabled() && overlay_->isChecked(); }

 signals:
  void saveRequested();
  void cancelRequested();

 private:
  void addKinds(QFormLayout& form);
  void addFocus(QFormLayout& form);
  void addSizes(QFormLayout& form);
  void adapt();

  QComboBox* kind_;
  QComboBox* path_;
  NumberSpin* nearest_;
  NumberSpin* farthest_;
  NumberSpin* seconds_;
  QSpinBox* width_;
  QCheckBox* overlay_;
  bool has_overlay_ = false;
};

}  // namespace episcope
