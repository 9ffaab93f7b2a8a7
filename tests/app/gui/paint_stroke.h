// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/main_window.h"
#include "app/gui/scene/viewer_area.h"
#include "widgets/canvas/view_canvas.h"

#include <QTest>

namespace episcope {

/// Drags the mouse over the view; where depends on the number of the stroke.
inline void paint_stroke(MainWindow& window, int number, Qt::MouseButton button = Qt::LeftButton) {
  ViewCanvas* canvas = window.bench().viewer_area.canvas();
  const auto at = [&](int i) {
    return canvas->positionOf({10 + (number * 13 + i * 5) % 70, 10 + (number * 29 + i * 7) % 70})
        .toPoint();
  };
  QTest::mousePress(canvas, button, {}, at(0));
  for (int i = 1; i < 6; ++i) QTest::mouseMove(canvas, at(i));
  QTest::mouseRelease(canvas, button, {}, at(6));
}

}  // namespace episcope
