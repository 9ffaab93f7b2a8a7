// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_tool.h"

#include <cmath>

namespace episcope {

void RectangleTool::press(const ToolPress& press) {
  begin_ = end_ = press.at;
}

void RectangleTool::drag(QPointF image) {
  if (!begin_) return;
  end_ = image;
  emit rectangleDragged(rectangle());
}

// Every pixel that the drag touched.
PixelRect RectangleTool::rectangle() const {
  const QRectF between = QRectF(*begin_, end_).normalized();
  return {static_cast<int>(std::floor(between.top())), static_cast<int>(std::floor(between.left())),
          static_cast<int>(std::ceil(between.bottom())),
          static_cast<int>(std::ceil(between.right()))};
}

bool RectangleTool::end() {
  if (!begin_) return false;
  const PixelRect drawn = rectangle();
  const bool is_click = *begin_ == end_;
  begin_.reset();
  if (is_click) {
    emit rectangleCancelled();
  } else {
    emit rectangleDrawn(drawn);
  }
  return true;
}

bool RectangleTool::cancel() {
  if (!begin_) return false;
  begin_.reset();
  emit rectangleCancelled();
  return true;
}

}  // namespace episcope

#include "moc_canvas_tool.cpp"
