// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <QImage>
#include <QTimer>
#include <QToolButton>
#include <QWidget>

#include <optional>
#include <vector>

class QAction;
class QComboBox;
class QLabel;
class QPainter;

namespace episcope {

class ViewGridCells;

/// The camera grid as v × u thumbnails with the current view marked, and a play button. Works for
/// any grid from 1×1: cells scale with the panel, down to plain squares. Keys are the host's.
class ViewGrid : public QWidget {
  Q_OBJECT

 public:
  explicit ViewGrid(QWidget* parent = nullptr);

  /// Starts a light field: no thumbnails, center view current, playing stops.
  void setGrid(GridShape grid);
  void setCurrent(ViewIndex view);
  /// Tells that another light field is being read, in place of thumbnails.
  void setOpening(bool is_opening);
  /// Ignored for a view outside the grid.
  void setThumbnail(ViewIndex view, const QImage& thumbnail);
  void setPainted(const std::vector<ViewIndex>& views);
  /// Marks the views that are done while all are worked on; empty = no work is under way.
  void setDone(const std::vector<ViewIndex>& views);

  [[nodiscard]] GridShape grid() const;
  [[nodiscard]] ViewIndex current() const;
  [[nodiscard]] bool isPlaying() const { return timer_.isActive(); }
  [[nodiscard]] ViewGridCells* cells() const { return cells_; }
  /// Largest useful size of a thumbnail, in device pixels.
  [[nodiscard]] QSize thumbnailSize() const;
  /// Keeps the play button's tool tip equal to its command's, including the key.
  void followTip(const QAction* play);

 public slots:
  void setPlaying(bool playing);

 signals:
  /// The user or the player requests this view.
  void viewSelected(episcope::ViewIndex view);

 private:
  void select(ViewIndex view);
  void playNext();

  ViewGridCells* cells_;
  QToolButton* play_;
  QComboBox* path_;
  QLabel* position_;
  QTimer timer_;
  std::vector<ViewIndex> loop_;
  std::size_t place_ = 0;  ///< In `loop_`.
};

/// The cells of a ViewGrid: input and painting, without playing.
class ViewGridCells : public QWidget {
  Q_OBJECT

 public:
  explicit ViewGridCells(QWidget* parent = nullptr);

  void setGrid(GridShape grid);
  void setCurrent(ViewIndex view);
  void setOpening(bool is_opening);
  void setThumbnail(ViewIndex view, const QImage& thumbnail);
  void setPainted(const std::vector<ViewIndex>& views);
  void setDone(const std::vector<ViewIndex>& views);
  [[nodiscard]] const std::vector<ViewIndex>& done() const { return done_; }

  [[nodiscard]] GridShape grid() const { return grid_; }
  [[nodiscard]] ViewIndex current() const { return current_; }
  /// Area of a cell in widget coordinates.
  [[nodiscard]] QRectF cellRect(ViewIndex view) const;
  [[nodiscard]] std::optional<ViewIndex> viewAt(QPointF position) const;

  [[nodiscard]] QSize sizeHint() const override { return {190, heightForWidth(190)}; }
  [[nodiscard]] QSize minimumSizeHint() const override { return {96, 64}; }
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
  std::vector<ViewIndex> done_;
  std::vector<QImage> thumbnails_;
  std::vector<ViewIndex> painted_;
};

}  // namespace episcope
