// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/view_grid.h"

#include "engine/render/movie.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QHelpEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

using render::CameraPath;

constexpr int kPlayInterval = 90;  // ms a view: eleven a second show parallax smoothly.

}  // namespace

ViewGrid::ViewGrid(QWidget* parent)
    : QWidget(parent),
      cells_(new ViewGridCells(this)),
      play_(named("viewGrid.play", new QToolButton(this))),
      path_(named("viewGrid.path", new QComboBox(this))),
      position_(named("viewGrid.position", new QLabel(this))) {
  setObjectName("viewGrid");
  play_->setCheckable(true);
  play_->setAutoRaise(true);
  play_->setIcon(themed_icon("play"));
  play_->setToolTip(tr("Plays the views one after the other"));
  path_->addItem(tr("circle"), static_cast<int>(CameraPath::Circle));
  path_->addItem(tr("swing"), static_cast<int>(CameraPath::Swing));
  path_->addItem(tr("snake"), static_cast<int>(CameraPath::Snake));
  path_->setToolTip(tr("Order in which the views are played"));
  position_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  timer_.setInterval(kPlayInterval);

  auto* row = make_row({play_, path_, {position_, 1}}, {.spacing = theme::kSpacing});
  make_column(this, {{cells_, 1}, row}, {.spacing = theme::kSpacing});

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
  position_->setVisible(!is_opening);
}

void ViewGrid::setCurrent(ViewIndex view) {
  cells_->setCurrent(view);
  position_->setText(grid().count() > 0 ? tr("v %1  u %2").arg(view.v).arg(view.u) : QString());
}

void ViewGrid::setThumbnail(ViewIndex view, const QImage& thumbnail) {
  cells_->setThumbnail(view, thumbnail);
}

void ViewGrid::setDone(const std::vector<ViewIndex>& views) {
  cells_->setDone(views);
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
  Quietly(play_)->setChecked(playing);
  if (playing == timer_.isActive()) return;
  play_->setIcon(themed_icon(playing ? "pause" : "play"));
  if (playing) {
    timer_.start();
  } else {
    timer_.stop();
  }
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

namespace {

/// Cells of a single row are at least as high, and of a single column as wide, to be aimed at.
constexpr double kLeastAcross = 28;
/// Of a cell; of views that are flatter or narrower, it shows the middle.
constexpr double kMostAspect = 3;

// The middle of a thumbnail, in the proportions of its cell.
QRectF middle_of(const QImage& thumbnail, const QSizeF& cell) {
  const QSizeF part = cell.scaled(thumbnail.size(), Qt::KeepAspectRatio);
  QRectF middle({}, part);
  middle.moveCenter(QRectF(thumbnail.rect()).center());
  return middle;
}

}  // namespace

ViewGridCells::ViewGridCells(QWidget* parent) : QWidget(parent) {
  setObjectName("viewGridCells");
  setFocusPolicy(Qt::StrongFocus);
  setAccessibleName(tr("Views"));
  QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  policy.setHeightForWidth(true);
  setSizePolicy(policy);
}

void ViewGridCells::setGrid(GridShape grid) {
  grid_ = grid;
  current_ = grid.center();
  thumbnails_.assign(static_cast<std::size_t>(std::max(0, grid.count())), QImage());
  painted_.clear();
  updateGeometry();
  update();
}

void ViewGridCells::setOpening(bool is_opening) {
  is_opening_ = is_opening;
  update();
}

void ViewGridCells::setCurrent(ViewIndex view) {
  if (view == current_) return;
  current_ = view;
  update();
}

void ViewGridCells::setThumbnail(ViewIndex view, const QImage& thumbnail) {
  if (!grid_.contains(view)) return;
  const double before = aspect();
  thumbnails_[static_cast<std::size_t>(view.v) * grid_.u + view.u] = thumbnail;
  if (aspect() != before) updateGeometry();
  update();
}

void ViewGridCells::setDone(const std::vector<ViewIndex>& views) {
  if (views.empty() && done_.empty()) return;
  done_ = views;
  update();
}

void ViewGridCells::setPainted(const std::vector<ViewIndex>& views) {
  painted_ = views;
  update();
}

double ViewGridCells::aspect() const {
  for (const auto& thumbnail : thumbnails_) {
    if (thumbnail.isNull()) continue;
    return std::clamp(1.0 * thumbnail.height() / thumbnail.width(), 1 / kMostAspect, kMostAspect);
  }
  return 1;
}

QRectF ViewGridCells::cellRect(ViewIndex view) const {
  double wide = std::min(1.0 * width() / grid_.u, height() / (grid_.v * aspect()));
  double high = wide * aspect();
  if (grid_.v == 1) high = std::max(high, std::min(kLeastAcross, 1.0 * height()));
  if (grid_.u == 1) wide = std::max(wide, std::min(kLeastAcross, 1.0 * width()));
  const double left = (width() - wide * grid_.u) / 2;
  const double top = (height() - high * grid_.v) / 2;
  return {left + view.u * wide, top + view.v * high, wide, high};
}

std::optional<ViewIndex> ViewGridCells::viewAt(QPointF position) const {
  if (grid_.count() <= 0) return std::nullopt;
  const QRectF first = cellRect({0, 0});
  const ViewIndex view{static_cast<int>(std::floor((position.y() - first.top()) / first.height())),
                       static_cast<int>(std::floor((position.x() - first.left()) / first.width()))};
  if (!grid_.contains(view)) return std::nullopt;
  return view;
}

int ViewGridCells::heightForWidth(int width) const {
  if (grid_.count() <= 0) return width;
  const double height = 1.0 * width / grid_.u * aspect() * grid_.v;
  return static_cast<int>(std::ceil(std::max(height, kLeastAcross)));
}

bool ViewGridCells::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    const auto* help = static_cast<QHelpEvent*>(event);
    if (const auto view = viewAt(help->pos())) {
      const bool is_painted = std::find(painted_.begin(), painted_.end(), *view) != painted_.end();
      const QString name = tr("view v %1, u %2").arg(view->v).arg(view->u);
      QToolTip::showText(help->globalPos(), is_painted ? tr("%1: painted").arg(name) : name, this);
    } else {
      QToolTip::hideText();
    }
    return true;
  }
  return QWidget::event(event);
}

void ViewGridCells::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  if (grid_.count() <= 0 || is_opening_) {
    painter.setPen(theme::muted_text(palette()));
    painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap,
                     is_opening_ ? tr("Opening …") : tr("No views"));
    return;
  }
  const double gap = cellRect({0, 0}).width() >= 14 ? 2 : 1;
  const QColor blank =
      theme::blend(palette().color(QPalette::Window), palette().color(QPalette::WindowText), 0.25);
  for (int v = 0; v < grid_.v; ++v) {
    for (int u = 0; u < grid_.u; ++u) {
      const QRectF cell = cellRect({v, u}).adjusted(0, 0, -gap, -gap);
      const QImage& thumbnail = thumbnails_[static_cast<std::size_t>(v) * grid_.u + u];
      if (thumbnail.isNull()) {
        painter.fillRect(cell, blank);
      } else {
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(cell, thumbnail, middle_of(thumbnail, cell.size()));
      }
    }
  }
  const QRectF marked = cellRect(current_).adjusted(0, 0, -gap, -gap);
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(Qt::black, 3));
  painter.drawRect(marked);
  painter.setPen(QPen(theme::kCrossHair, hasFocus() ? 2 : 1.5));
  painter.drawRect(marked);
  constexpr double kBar = 3;
  for (const ViewIndex view : done_) {
    if (!grid_.contains(view)) continue;
    const QRectF cell = cellRect(view).adjusted(0, 0, -gap, -gap);
    painter.fillRect(QRectF(cell.left(), cell.bottom() - kBar, cell.width(), kBar),
                     theme::kPainted);
  }
  for (const ViewIndex view : painted_) {
    if (grid_.contains(view)) paintMark(painter, cellRect(view).adjusted(0, 0, -gap, -gap));
  }
}

// A corner with a dark rim, seen on any thumbnail.
void ViewGridCells::paintMark(QPainter& painter, const QRectF& cell) const {
  const double side = std::max(4.0, std::min(cell.width(), cell.height()) * 0.4);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(0, 0, 0, 180), 1));
  painter.setBrush(theme::kPainted);
  painter.drawPolygon(QPolygonF(
      {cell.topRight(), cell.topRight() + QPointF(0, side), cell.topRight() - QPointF(side, 0)}));
  painter.restore();
}

void ViewGridCells::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const auto view = viewAt(event->position())) emit viewClicked(*view);
}

void ViewGridCells::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  if (const auto view = viewAt(event->position()); view && *view != current_) {
    emit viewClicked(*view);
  }
}

}  // namespace episcope

#include "moc_view_grid.cpp"
