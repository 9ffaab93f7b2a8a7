// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/pixel_rect.h"
#include "widgets/canvas/tools/canvas_tool.h"

#include <optional>

namespace episcope {

/// Draws rectangles of whole pixels by drags of either button, from corner to corner.
class RectangleTool : public CanvasTool {
  Q_OBJECT

 public:
  using CanvasTool::CanvasTool;

  void press(const ToolPress& press) override;
  void drag(QPointF image) override;
  bool end() override;
  bool cancel() override;
  [[nodiscard]] QCursor cursor() const override { return Qt::CrossCursor; }

 signals:
  /// While it is drawn; may reach beyond the image.
  void rectangleDragged(const episcope::PixelRect& rectangle);
  /// The button was released; not after a click.
  void rectangleDrawn(const episcope::PixelRect& rectangle);
  void rectangleCancelled();

 private:
  [[nodiscard]] PixelRect rectangle() const;

  std::optional<QPointF> begin_;  // none between gestures
  QPointF end_;
};

}  // namespace episcope
