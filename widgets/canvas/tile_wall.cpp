// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tile_wall.h"

#include "widgets/controls/theme.h"

#include <QResizeEvent>
#include <QScrollBar>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

constexpr int kTileGap = 2;
constexpr int kLeastTileWidth = 170;  // logical pixels; smaller tiles say nothing
constexpr int kLeastHeight = 140;

}  // namespace

LinkedZoom zoom_of(const ViewCanvas& canvas) {
  const CanvasTransform transform = canvas.canvasTransform();
  return {transform.scale / canvas.fitScale(), transform.center, canvas.isFitted()};
}

void set_zoom(ViewCanvas& canvas, const LinkedZoom& zoom) {
  if (zoom.is_fitted) {
    canvas.zoomToFit();
  } else {
    canvas.setCanvasTransform({zoom.relative_scale * canvas.fitScale(), zoom.center});
  }
}

int best_columns(int count, QSizeF picture, QSizeF wall) {
  int best = 1;
  double best_scale = 0;
  for (int columns = 1; columns <= count; ++columns) {
    const int rows = (count + columns - 1) / columns;
    const double scale =
        fit_transform(picture, {wall.width() / columns, wall.height() / rows}).scale;
    if (scale > best_scale * 1.001) {
      best_scale = scale;
      best = columns;
    }
  }
  return best;
}

TileWall::TileWall(QWidget* parent) : QScrollArea(parent), wall_(new QWidget) {
  setObjectName("tileWall");
  setFrameShape(QFrame::NoFrame);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  setWidget(wall_);
  QPalette ground;  // what no tile covers looks as the tiles do
  ground.setColor(QPalette::Window, theme::kCanvas);
  setPalette(ground);
  setFocusPolicy(Qt::StrongFocus);
}

ViewCanvas* TileWall::addTile() {
  auto* tile = new ViewCanvas(wall_);
  const auto index = tiles_.size();
  tile->setObjectName(QString("tile.%1").arg(index));
  tile->setParallaxEnabled(false);
  connect(tile, &ViewCanvas::transformChanged, this, [this, tile] { follow(tile); });
  connect(tile, &ViewCanvas::crossHairRequested, this, [this, index](PixelIndex pixel) {
    emit crossHairRequested(pixel);
    emit chosen(ids_[index]);
  });
  connect(tile, &ViewCanvas::centerRequested, this, [this, index] { emit opened(ids_[index]); });
  connect(tile, &ViewCanvas::focusRequested, this, &TileWall::focusRequested);
  connect(tile, &ViewCanvas::menuRequested, this, &TileWall::menuRequested);
  connect(tile, &ViewCanvas::cursorMoved, this, &TileWall::cursorMoved);
  connect(tile, &ViewCanvas::spaceTapped, this, &TileWall::spaceTapped);
  connect(tile, &ViewCanvas::focusStepped, this, &TileWall::focusStepped);
  tiles_.push_back(tile);
  return tile;
}

void TileWall::setTiles(const std::vector<Tile>& tiles) {
  const LinkedZoom before = zoom();
  const bool is_new_count = tiles.size() != ids_.size();
  while (tiles_.size() < tiles.size()) addTile();
  ids_.clear();
  is_following_ = true;  // a new tile fits itself: that is no zoom of the user's
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    ViewCanvas* canvas = tiles_[i];
    canvas->setVisible(i < tiles.size());
    if (i >= tiles.size()) continue;
    ids_.push_back(tiles[i].id);
    if (tiles[i].picture.isNull()) {
      canvas->showLoading(tiles[i].caption, -1);
    } else {
      canvas->setPicture(tiles[i].picture);
    }
    canvas->setPixelText(tiles[i].pixel_text);
    canvas->setCaption(tiles[i].caption, tiles[i].side);
  }
  is_following_ = false;
  if (is_new_count || columns_ == 0) arrange();
  setZoom(before);
}

void TileWall::setCrossHair(std::optional<PixelIndex> pixel) {
  for (int i = 0; i < count(); ++i) tile(i)->setCrossHair(pixel);
}

LinkedZoom TileWall::zoom() const {
  for (int i = 0; i < count(); ++i) {
    if (!tile(i)->picture().isNull()) return zoom_of(*tile(i));
  }
  return {};
}

void TileWall::setZoom(const LinkedZoom& zoom) {
  const bool was_following = std::exchange(is_following_, true);
  for (int i = 0; i < count(); ++i) set_zoom(*tile(i), zoom);
  is_following_ = was_following;
}

ViewCanvas* TileWall::active() const {
  for (int i = 0; i < count(); ++i) {
    if (tile(i)->underMouse()) return tile(i);
  }
  return count() == 0 ? nullptr : tile(0);
}

void TileWall::follow(const ViewCanvas* source) {
  if (is_following_ || !source->isVisible()) return;
  const LinkedZoom zoom = zoom_of(*source);
  setZoom(zoom);
  emit zoomChanged(zoom);
}

void TileWall::resizeEvent(QResizeEvent* event) {
  QScrollArea::resizeEvent(event);
  arrange();
}

// By hand: all tiles get the very same size, which a layout does not promise.
void TileWall::arrange() {
  const QSize room = viewport()->size();
  if (count() == 0 || room.isEmpty()) return;
  const LinkedZoom before = zoom();
  const QSize picture = tile(0)->picture().isNull() ? QSize(1, 1) : tile(0)->picture().size();
  columns_ =
      std::min(best_columns(count(), picture, room), std::max(1, room.width() / kLeastTileWidth));
  const int rows = (count() + columns_ - 1) / columns_;
  const QSize size(room.width() / columns_ - kTileGap,
                   std::max(kLeastHeight, room.height() / rows - kTileGap));
  wall_->resize(room.width(), rows * (size.height() + kTileGap));
  verticalScrollBar()->setSingleStep(size.height() + kTileGap);
  is_following_ = true;
  for (int i = 0; i < count(); ++i) {
    tile(i)->setGeometry(QRect(
        QPoint(i % columns_ * (size.width() + kTileGap), i / columns_ * (size.height() + kTileGap)),
        size));
  }
  is_following_ = false;
  setZoom(before);
}

}  // namespace episcope

#include "moc_tile_wall.cpp"
