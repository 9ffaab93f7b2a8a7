// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/tools/outline_tool.h"

namespace episcope {

/// Draws around a region corner by corner: each click sets one, a double click closes it. It stays
/// in hand while other views are shown.
class PolygonTool : public OutlineTool {
  Q_OBJECT

 public:
  using OutlineTool::OutlineTool;

  void press(const ToolPress& press) override;
  void hover(QPointF image) override;
  /// Closes it; false if nothing is drawn.
  bool closeUp();
  /// Takes the last corner back; false if nothing is drawn.
  bool takeBack();
};

}  // namespace episcope
