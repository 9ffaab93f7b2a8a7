// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/canvas/view_canvas.h"

#include <QScrollArea>

#include <vector>

namespace episcope {

/// A picture of the wall.
struct Tile {
  quint64 id = 0;
  QString caption;
  Side side = Side::None;
  QImage picture;                         ///< Null: still being made.
  ViewCanvas::PixelText pixel_text = {};  ///< Printed when zoomed in far enough; may be empty.
};

/// Zoom shared by canvases of different sizes.
struct LinkedZoom {
  double relative_scale = 1;  ///< 1 = the whole picture just fits.
  QPointF center;             ///< Image point in the middle.
  bool is_fitted = true;
};

/// Pictures of the same size side by side, with zoom, pan and cross-hair linked. As many columns as
/// make the pictures largest; where they would become too small, the wall scrolls.
///
/// A click chooses a tile and moves the cross-hair, a double click asks for it alone; a drag pans.
class TileWall : public QScrollArea {
  Q_OBJECT

 public:
  explicit TileWall(QWidget* parent = nullptr);

  void setTiles(const std::vector<Tile>& tiles);
  void setCrossHair(std::optional<PixelIndex> pixel);
  void setZoom(const LinkedZoom& zoom);

  [[nodiscard]] LinkedZoom zoom() const;
  [[nodiscard]] int count() const { return static_cast<int>(ids_.size()); }
  [[nodiscard]] int columns() const { return columns_; }
  /// Tile by its index in `setTiles`.
  [[nodiscard]] ViewCanvas* tile(int index) const {
    return tiles_[static_cast<std::size_t>(index)];
  }
  /// Target of zoom commands: the tile under the mouse, else the first; null without tiles.
  [[nodiscard]] ViewCanvas* active() const;

 signals:
  void zoomChanged(const episcope::LinkedZoom& zoom);
  void chosen(quint64 id);
  void opened(quint64 id);
  void crossHairRequested(episcope::PixelIndex pixel);
  void focusRequested(episcope::PixelIndex pixel);
  void menuRequested(episcope::PixelIndex pixel, QPoint place);
  void cursorMoved(std::optional<episcope::PixelIndex> pixel);
  void spaceTapped();
  void focusStepped(double steps);

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  ViewCanvas* addTile();
  void arrange();
  void follow(const ViewCanvas* source);

  QWidget* wall_;
  std::vector<ViewCanvas*> tiles_;  // more than ids_ are hidden
  std::vector<quint64> ids_;
  int columns_ = 0;
  bool is_following_ = false;
};

[[nodiscard]] LinkedZoom zoom_of(const ViewCanvas& canvas);
void set_zoom(ViewCanvas& canvas, const LinkedZoom& zoom);

/// Number of columns that makes `count` pictures largest in `wall`.
[[nodiscard]] int best_columns(int count, QSizeF picture, QSizeF wall);

}  // namespace episcope
