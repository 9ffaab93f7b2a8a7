// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/tools/outline_tool.h"

namespace episcope {

/// Draws around a region in one drag; the release closes it.
class LassoTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override { begin(press); }
  void drag(QPointF image) override;
  bool end() override;
};

}  // namespace episcope
