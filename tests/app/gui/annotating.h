// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/annotate/segment_controller.h"
#include "app/gui/scene/document_controller.h"
#include "tests/app/gui/window_fixture.h"

#include <QColor>

namespace episcope {

/// The window in annotate mode.
class Annotating : public WindowFixture {
 public:
  static constexpr ViewIndex kCenter{4, 4};

  /// On a small built-in scene; nothing is painted on `edge`.
  explicit Annotating(const std::string& id = "edge");

  int labelAt(PixelIndex pixel, ViewIndex view = kCenter) {
    return document().scribbles().label_at(view, pixel);
  }
  /// What is painted, as it is drawn over the view.
  [[nodiscard]] QColor shownAt(PixelIndex pixel) const;

  SegmentController& segment() { return find<SegmentController>(window); }
  /// Share of right pixels of the view.
  double accuracy();
};

}  // namespace episcope
