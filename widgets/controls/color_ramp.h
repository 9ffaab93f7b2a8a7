// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"

#include <QWidget>

namespace episcope {

/// The painted colour map of a ColorBar, low to high from left to right.
class ColorRamp : public QWidget {
  Q_OBJECT

 public:
  explicit ColorRamp(QWidget* parent = nullptr);

  void setShading(const render::Shading& shading);
  /// NaN = none.
  void setMarker(double value);
  [[nodiscard]] const render::Shading& shading() const { return shading_; }
  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  render::Shading shading_;
  double marker_;
};

}  // namespace episcope
