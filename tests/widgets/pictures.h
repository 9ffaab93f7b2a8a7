// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QApplication>
#include <QImage>
#include <QPoint>
#include <QWheelEvent>
#include <QWidget>

#include <set>

namespace episcope::test {

/// A picture in which every pixel has a color of its own: (x, y, 128).
inline QImage coordinate_picture(int width, int height) {
  QImage picture(width, height, QImage::Format_RGB32);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.setPixel(x, y, qRgb(x, y, 128));
  }
  return picture;
}

/// How many colors an image has.
inline std::size_t color_count(const QImage& image) {
  std::set<QRgb> colors;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) colors.insert(image.pixel(x, y));
  }
  return colors.size();
}

/// Turns the wheel by notches (positive = away from the user) over a place of a widget.
inline void turn_wheel(QWidget& widget, QPointF at, double notches,
                       Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
  QWheelEvent event(at, widget.mapToGlobal(at), {}, QPoint(0, static_cast<int>(120 * notches)),
                    Qt::NoButton, modifiers, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

}  // namespace episcope::test
