// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/polygon_tool.h"

namespace episcope {

void PolygonTool::press(const ToolPress& press) {
  if (!isDrawing()) {
    begin(press);
  } else if (press.is_double) {
    closeUp();  // its first click has set the last corner
  } else {
    addCorner(press.at);
  }
}

void PolygonTool::hover(QPointF image) {
  if (isDrawing()) setNext({image});
}

bool PolygonTool::closeUp() {
  if (!isDrawing()) return false;
  close();
  return true;
}

bool PolygonTool::takeBack() {
  if (!isDrawing()) return false;
  removeCorner();
  return true;
}

}  // namespace episcope

#include "moc_polygon_tool.cpp"
