// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/indices.h"

#include <QImage>
#include <QWidget>

#include <optional>
#include <vector>

class QPainter;

namespace episcope {

/// The painted cells of a ViewGrid: input and painting, nothing of playing.
class ViewGridCells : public QWidget {
  Q_OBJECT

 public:
  explicit ViewGridCells(QWidget* parent = nullptr);

  void setGrid(GridShape grid);
  void setCurrent(ViewIndex view);
  void setOpening(bool is_opening);
  void setThumbnail(ViewIndex view, const QImage& thumbnail);
  /// Marks views that are painted.
  void setPainted(const std::vector<ViewIndex>& views);

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] ViewIndex current() const { return current_; }
  /// Place of a cell in widget coordinates.
  [[nodiscard]] QRectF cellRect(ViewIndex view) const;
  [[nodiscard]] std::optional<ViewIndex> viewAt(QPointF position) const;

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] bool hasHeightForWidth() const override { return true; }
  [[nodiscard]] int heightForWidth(int width) const override;

 signals:
  void viewClicked(episcope::ViewIndex view);

 protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;

 private:
  void paintMark(QPainter& painter, const QRectF& cell) const;
  [[nodiscard]] double aspect() const;  ///< Height over width of a cell.

  GridShape grid_;
  ViewIndex current_;
  bool is_opening_ = false;
  std::vector<QImage> thumbnails_;
  std::vector<ViewIndex> painted_;
};

}  // namespace episcope
