// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/lasso_tool.h"

namespace episcope {

void LassoTool::drag(QPointF image) {
  if (isDrawing() && image != corners().back()) addCorner(image);
}

bool LassoTool::end() {
  if (!isDrawing()) return false;
  close();
  return true;
}

}  // namespace episcope

#include "moc_lasso_tool.cpp"
