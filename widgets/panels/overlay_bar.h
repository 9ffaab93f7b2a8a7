// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/render/quantity.h"

#include <QWidget>

#include <vector>

class QAction;
class QComboBox;
class QHBoxLayout;
class QLabel;
class QSlider;

namespace episcope {

class NumberSpin;

/// A row of controls above the canvas: overlay, opacity and focus plane (shear). Setters never
/// emit.
class OverlayBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr double kFarthestFocus = 100;

  explicit OverlayBar(QWidget* parent = nullptr);

  /// Quantities that are available; others are greyed out. "None" always is.
  void setAvailable(const std::vector<render::Quantity>& quantities);
  /// False: the host has another control for the quantity.
  void setSelectorVisible(bool visible);
  /// Quantity::View = no overlay.
  void setQuantity(render::Quantity quantity);
  void setOpacity(double opacity);
  /// Range of the focus slider, px per view step. The field beside it takes numbers up to
  /// kFarthestFocus and extends the slider.
  void setFocusRange(Interval range_px);
  void setFocus(double focus_px);
  /// Adds a button for a focus plane action, beside its controls.
  void addFocusAction(QAction* action);

  [[nodiscard]] render::Quantity quantity() const;
  [[nodiscard]] double opacity() const;
  [[nodiscard]] double focus() const;

 public slots:
  /// Selects the next available quantity, like the user ("next metric map").
  void selectNextQuantity();
  /// Moves the focus plane by slider steps, like the user.
  void stepFocus(double steps);

 signals:
  void quantitySelected(episcope::render::Quantity quantity);
  void opacityChanged(double opacity);
  void focusChanged(double focus_px);

 private:
  void showFocus(double focus_px);
  void changeFocus(double focus_px);

  QLabel* title_;
  QComboBox* quantity_;
  QSlider* opacity_;
  QSlider* focus_slider_;
  NumberSpin* focus_spin_;
  QHBoxLayout* row_;
};

}  // namespace episcope
