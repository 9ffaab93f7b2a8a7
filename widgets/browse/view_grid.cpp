// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/browse/view_grid.h"

#include "widgets/browse/view_grid_cells.h"
#include "widgets/controls/tool_button.h"
#include "widgets/style/icon.h"
#include "widgets/style/theme.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>

namespace episcope {
namespace {

using render::CameraPath;

constexpr int kPlayInterval = 90;  // ms a view: eleven a second show parallax smoothly.

}  // namespace

ViewGrid::ViewGrid(QWidget* parent)
    : QWidget(parent),
      cells_(new ViewGridCells(this)),
      play_(new QToolButton(this)),
      path_(new QComboBox(this)),
      position_(new QLabel(this)) {
  setObjectName("viewGrid");
  play_->setObjectName("viewGrid.play");
  play_->setCheckable(true);
  play_->setAutoRaise(true);
  play_->setIcon(themed_icon("play"));
  play_->setToolTip(tr("Plays the views one after the other"));
  path_->setObjectName("viewGrid.path");
  path_->addItem(tr("circle"), static_cast<int>(CameraPath::Circle));
  path_->addItem(tr("swing"), static_cast<int>(CameraPath::Swing));
  path_->addItem(tr("snake"), static_cast<int>(CameraPath::Snake));
  path_->setToolTip(tr("Order in which the views are played"));
  position_->setObjectName("viewGrid.position");
  position_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  timer_.setInterval(kPlayInterval);

  auto* row = new QHBoxLayout;
  row->setSpacing(theme::kSpacing);
  row->addWidget(play_);
  row->addWidget(path_);
  row->addWidget(position_, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(cells_, 1);
  layout->addLayout(row);

  connect(cells_, &ViewGridCells::viewClicked, this, &ViewGrid::select);
  connect(play_, &QToolButton::toggled, this, &ViewGrid::setPlaying);
  connect(path_, &QComboBox::currentIndexChanged, this, [this] {
    loop_ = render::camera_path(grid(), static_cast<CameraPath>(path_->currentData().toInt()));
  });
  connect(&timer_, &QTimer::timeout, this, &ViewGrid::playNext);
  setGrid({});
}

void ViewGrid::setGrid(GridShape grid) {
  setPlaying(false);
  cells_->setGrid(grid);
  loop_ = render::camera_path(grid, static_cast<CameraPath>(path_->currentData().toInt()));
  play_->setEnabled(grid.count() > 1);
  path_->setEnabled(grid.count() > 1);
  setCurrent(grid.center());
}

void ViewGrid::setOpening(bool is_opening) {
  cells_->setOpening(is_opening);
}

void ViewGrid::setCurrent(ViewIndex view) {
  cells_->setCurrent(view);
  position_->setText(grid().count() > 0 ? tr("v %1  u %2").arg(view.v).arg(view.u) : QString());
}

void ViewGrid::setThumbnail(ViewIndex view, const QImage& thumbnail) {
  cells_->setThumbnail(view, thumbnail);
}

void ViewGrid::setPainted(const std::vector<ViewIndex>& views) {
  cells_->setPainted(views);
}

GridShape ViewGrid::grid() const {
  return cells_->grid();
}
ViewIndex ViewGrid::current() const {
  return cells_->current();
}

QSize ViewGrid::thumbnailSize() const {
  if (grid().count() <= 0) return {};
  const QSizeF cell = cells_->cellRect({0, 0}).size() * devicePixelRatioF();
  // Room for a wider panel later.
  return (cell * 2).toSize().expandedTo({24, 24});
}

void ViewGrid::select(ViewIndex view) {
  if (!grid().contains(view)) return;
  emit viewSelected(view);
}

void ViewGrid::followTip(const QAction* play) {
  follow_tip(play_, play);
}

void ViewGrid::setPlaying(bool playing) {
  playing = playing && loop_.size() > 1;
  const QSignalBlocker blocker(play_);
  play_->setChecked(playing);
  if (playing == timer_.isActive()) return;
  play_->setIcon(themed_icon(playing ? "pause" : "play"));
  if (playing) {
    timer_.start();
  } else {
    timer_.stop();
  }
  emit playingChanged(playing);
}

void ViewGrid::setPlayPath(CameraPath path) {
  path_->setCurrentIndex(path_->findData(static_cast<int>(path)));
}

void ViewGrid::playNext() {
  // A path may pass a view twice, so the place is kept, unless the user went elsewhere.
  if (place_ >= loop_.size() || loop_[place_] != current()) {
    const auto here = std::find(loop_.begin(), loop_.end(), current());
    place_ = here == loop_.end() ? loop_.size() - 1 : here - loop_.begin();
  }
  place_ = (place_ + 1) % loop_.size();
  select(loop_[place_]);
}

}  // namespace episcope

#include "moc_view_grid.cpp"
