// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <QString>
#include <QToolButton>
#include <QWidget>

#include <vector>

class QAction;
class QLabel;

namespace episcope {

class ColorRamp;
class NumberSpin;

/// Legend of an overlay: name and unit, the color map between two editable limits or the colors of
/// a few classes, the color of invalid pixels, a lock, and a button for the automatic range.
/// Setters never emit.
class ColorBar : public QWidget {
  Q_OBJECT

 public:
  explicit ColorBar(QWidget* parent = nullptr);

  void setShading(const QString& title, const QString& unit, const render::Shading& shading);
  /// Shows colors with their meanings instead of a ramp: for maps of classes.
  struct Swatch {
    Rgb color{};
    QString text;
  };
  void setSwatches(const QString& title, const std::vector<Swatch>& swatches, const Rgb& invalid);
  /// Marks a value on the ramp, e.g. at the cursor; NaN = none.
  void setMarker(double value);
  void setRangeLocked(bool locked);

  /// Keeps the buttons' tool tips equal to their commands', including keys.
  void followTips(const QAction* automatic, const QAction* own);

  [[nodiscard]] Interval range() const;
  [[nodiscard]] bool isRangeLocked() const { return lock_->isChecked(); }

 signals:
  void rangeEdited(episcope::Interval range);
  /// The user wants a range from the data of this map.
  void automaticRangeRequested();
  /// The user wants the quantity's own range.
  void ownRangeRequested();

 private:
  void editRange();
  void setTitle(const QString& title);
  void setRampShown(bool is_shown);

  QLabel* title_;
  ColorRamp* ramp_;
  NumberSpin* min_;
  NumberSpin* max_;
  QLabel* swatches_;
  QLabel* invalid_;
  QToolButton* lock_;
  QToolButton* automatic_;
  QToolButton* own_;
};

/// The color map of a ColorBar, low to high from left to right.
class ColorRamp : public QWidget {
  Q_OBJECT

 public:
  explicit ColorRamp(QWidget* parent = nullptr);

  void setShading(const render::Shading& shading);
  /// NaN = none.
  void setMarker(double value);
  [[nodiscard]] const render::Shading& shading() const { return shading_; }
  [[nodiscard]] QSize sizeHint() const override { return {120, 16}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {60, 14}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  render::Shading shading_;
  double marker_;
};

}  // namespace episcope
