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

/// One row of controls above the canvas: which overlay, how opaque, and the focus plane (shear).
/// Setters never emit.
class OverlayBar : public QWidget {
  Q_OBJECT

 public:
  static constexpr double kFarthestFocus = 100;

  explicit OverlayBar(QWidget* parent = nullptr);

  /// Quantities that can be shown now; others are listed greyed out. "None" always can.
  void setAvailable(const std::vector<render::Quantity>& quantities);
  /// Off: the host has another way to choose the quantity.
  void setSelectorVisible(bool visible);
  /// Quantity::View = no overlay.
  void setQuantity(render::Quantity quantity);
  void setOpacity(double opacity);
  /// Reach of the focus slider, px per view step. The field beside it takes numbers of up to
  /// kFarthestFocus; the slider then reaches that far too.
  void setFocusRange(Interval range_px);
  void setFocus(double focus_px);
  /// A button for what can be done with the focus plane, beside its controls.
  void addFocusAction(QAction* action);

  [[nodiscard]] render::Quantity quantity() const;
  [[nodiscard]] double opacity() const;
  [[nodiscard]] double focus() const;

 public slots:
  /// As if the user chose the next available quantity ("next metric map").
  void selectNextQuantity();
  /// As if the user moved the focus plane by slider steps.
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
