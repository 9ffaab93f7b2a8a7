// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/tools/stroke_tool.h"

namespace episcope {

/// Fills the region under a click, or empties it with the right button.
class FillTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override;
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }

 signals:
  void fillRequested(const episcope::StrokeStart& start);
};

}  // namespace episcope
