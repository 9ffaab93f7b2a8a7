// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/commands.h"
#include "tests/app/gui/window_fixture.h"
#include "tests/window_test_main.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"

#include <QTreeWidget>

#include <limits>
#include <memory>
#include <vector>

namespace episcope {

/// The window with a scene and results that are off the truth by known amounts.
class Compared : public WindowFixture {
 public:
  explicit Compared(std::vector<float> offsets) {
    openSmall();
    for (const float offset : offsets) add(offset);
    // The session tells the window of them one turn later.
    const auto* tree = window.findChild<QTreeWidget*>("results.tree");
    [&] {
      QTRY_COMPARE_WITH_TIMEOUT(tree->topLevelItemCount(), static_cast<int>(offsets.size()),
                                kPatience);
    }();
    window.bench().viewer_area.canvas()->setFocus();
  }

  int add(float offset) {
    const auto& truth = window.bench().session.scene()->truth->field.disparity;
    auto estimate = std::make_shared<Estimate>();
    estimate->method = "off";
    estimate->field.disparity = truth.clone();
    float* values = estimate->field.disparity.data();
    for (std::size_t i = 0; i < truth.size(); ++i) values[i] += offset;
    values[0] = std::numeric_limits<float>::quiet_NaN();
    ids.push_back(window.bench().session.add_estimate(estimate, {-1, 1},
                                                      window.bench().session.generation()));
    window.bench().session.mark_saved(ids.back());
    return ids.back();
  }

  Session& session() { return window.bench().session; }
  TileWall* wall() { return window.bench().viewer_area.wall(); }
  void key(Qt::Key key) {
    window.activateWindow();  // shortcuts are heard in the active window only
    QVERIFY(QTest::qWaitForWindowActive(&window));
    QTest::keyClick(QApplication::focusWidget() ? QApplication::focusWidget() : canvas(), key);
  }

  std::vector<int> ids;
};

inline void click_pixel(ViewCanvas* canvas, PixelIndex pixel) {
  QTest::mouseClick(canvas, Qt::LeftButton, {}, canvas->positionOf(pixel).toPoint());
}

}  // namespace episcope
