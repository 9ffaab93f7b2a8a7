// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/tools/canvas_tool.h"

namespace episcope {

/// Picks points by clicks of either button.
class PointTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override { emit pointPicked(press.at); }
  [[nodiscard]] QCursor cursor() const override { return Qt::PointingHandCursor; }

 signals:
  /// In image coordinates, between pixels.
  void pointPicked(QPointF image);
};

}  // namespace episcope
