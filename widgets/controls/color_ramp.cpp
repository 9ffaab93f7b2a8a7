// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/color_ramp.h"

#include <QImage>
#include <QPainter>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {

ColorRamp::ColorRamp(QWidget* parent)
    : QWidget(parent), marker_(std::numeric_limits<double>::quiet_NaN()) {
  setObjectName("colorBar.ramp");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ColorRamp::setShading(const render::Shading& shading) {
  shading_ = shading;
  update();
}

void ColorRamp::setMarker(double value) {
  marker_ = value;
  update();
}

QSize ColorRamp::sizeHint() const {
  return {120, 16};
}
QSize ColorRamp::minimumSizeHint() const {
  return {60, 14};
}

void ColorRamp::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QImage ramp(static_cast<int>(shading_.map.colors.size()), 1, QImage::Format_RGB32);
  for (int i = 0; i < ramp.width(); ++i) {
    const auto [red, green, blue] = shading_.map.colors[static_cast<std::size_t>(i)];
    ramp.setPixel(i, 0, qRgb(red, green, blue));
  }
  const QRectF area = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  painter.drawImage(area, ramp);
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(area);
  if (!std::isfinite(marker_) || shading_.range.length() <= 0) return;
  const double part =
      std::clamp((marker_ - shading_.range.min) / shading_.range.length(), 0.0, 1.0);
  const double x = area.left() + part * area.width();
  painter.setPen(QPen(Qt::black, 3));
  painter.drawLine(QLineF(x, area.top(), x, area.bottom()));
  painter.setPen(QPen(Qt::white, 1));
  painter.drawLine(QLineF(x, area.top(), x, area.bottom()));
}

}  // namespace episcope

#include "moc_color_ramp.cpp"
