// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/scene/viewer_area.h"

#include "app/gui/shell/panes.h"
#include "app/session/session.h"
#include "widgets/canvas/epi_pane.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/panels/color_bar.h"
#include "widgets/panels/overlay_bar.h"

#include <QApplication>
#include <QEvent>
#include <QSplitter>
#include <QStackedLayout>

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

// Sizes of the view and the EPIs until the user drags between them.
constexpr int kCanvasWidth = 600;
constexpr int kCanvasHeight = 500;
constexpr int kEpiWidth = 145;  // and of the legend under it
constexpr int kEpiHeight = 92;
constexpr int kEpiShare = 3;  // of the room at most that an EPI takes by itself
constexpr int kThinner = 4;   // times at most that one EPI is thinner than the other

// What an EPI gets of `room` while the view needs `wanted` of it.
int epi_size(int room, int least, int wanted) {
  return std::clamp(room - wanted, least, std::max(least, room / kEpiShare));
}

// The legend is as wide as the vertical EPI above it.
void align(QSplitter& lower, const QSplitter& upper, const QWidget& vertical_epi) {
  if (vertical_epi.isVisible()) lower.setSizes(upper.sizes());
}

/// Holds the place of a pane, also while that is elsewhere.
QWidget* make_place(QWidget* pane) {
  auto* place = new QWidget;
  make_column(place, {pane});
  return place;
}

QWidget* make_legend(ColorBar* color_bar, QWidget* parent) {
  // Its place is kept while nothing is drawn over the view, so that the view does not jump.
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  policy.setRetainSizeWhenHidden(true);
  color_bar->setSizePolicy(policy);
  auto* legend = new QWidget(parent);
  make_column(legend, {kRoom, color_bar, kRoom},
              {.margins = {theme::kSpacing, 0, theme::kSpacing, 0}});
  return legend;
}

}  // namespace

ViewerArea::ViewerArea(QWidget* parent)
    : QWidget(parent),
      canvas_(new ViewCanvas(this)),
      wall_(new TileWall(this)),
      horizontal_epi_(new EpiPane(Qt::Horizontal, this)),
      vertical_epi_(new EpiPane(Qt::Vertical, this)),
      color_bar_(new ColorBar(this)),
      overlay_bar_(new OverlayBar(this)),
      rows_(named("split.rows", new QSplitter(Qt::Vertical, this))),
      upper_(named("split.upper", new QSplitter(Qt::Horizontal))),
      // At once, so that no frame shows them out of line: the upper row has its size by then.
      lower_(named("split.lower",
                   new ToldSplitter([this] { align(*lower_, *upper_, *vertical_place_); }))),
      vertical_place_(make_place(vertical_epi_)),
      horizontal_place_(make_place(horizontal_epi_)),
      legend_(make_legend(color_bar_, this)) {
  arrange();
  alignColumns();
}

void ViewerArea::arrange() {
  auto* center = new QWidget;
  center_ = new QStackedLayout(center);
  center_->addWidget(canvas_);
  center_->addWidget(wall_);
  upper_->addWidget(center);
  upper_->addWidget(vertical_place_);
  lower_->addWidget(horizontal_place_);
  lower_->addWidget(legend_);
  rows_->addWidget(upper_);
  rows_->addWidget(lower_);
  rows_->setSizes({kCanvasHeight, kEpiHeight});
  for (QSplitter* splitter : {rows_, upper_, lower_}) {
    splitter->setChildrenCollapsible(false);
    splitter->setHandleWidth(4);
    splitter->setStretchFactor(0, 1);  // what a larger window gives belongs to the view
    splitter->setStretchFactor(1, 0);
    if (splitter != rows_) splitter->setSizes({kCanvasWidth, kEpiWidth});
    set_divided_by_itself(*splitter, true);
  }
  make_column(this, {rows_});
}

void ViewerArea::fitEpis() {
  const QSize picture = canvas_->picture().size();
  if (picture.isEmpty() || center_->currentWidget() != canvas_) return;
  const int height = rows_->height() - rows_->handleWidth();
  const int width = upper_->width() - upper_->handleWidth();
  const auto wanted = [](int other, int other_side, int side) { return other * side / other_side; };
  const int epi_width =
      epi_size(width, kEpiWidth, wanted(height - kEpiHeight, picture.height(), picture.width()));
  const int epi_height = epi_size(height, std::max(kEpiHeight, epi_width / kThinner),
                                  wanted(width - epi_width, picture.width(), picture.height()));
  if (is_divided_by_itself(*rows_) && lower_->isVisible()) {
    rows_->setSizes({height - epi_height, epi_height});
  }
  if (!is_divided_by_itself(*upper_) || !vertical_place_->isVisible()) return;
  upper_->setSizes({width - epi_width, epi_width});
  align(*lower_, *upper_, *vertical_place_);
}

void ViewerArea::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  fitEpis();
}

void ViewerArea::alignColumns() {
  for (QSplitter* splitter : {rows_, upper_, lower_}) {
    connect(splitter, &QSplitter::splitterMoved, this, [this, splitter] {
      set_divided_by_itself(*splitter, false);
      if (splitter != rows_) set_divided_by_itself(*upper_, false);
    });
  }
  connect(canvas_, &ViewCanvas::pictureResized, this, &ViewerArea::fitEpis);
  connect(lower_, &QSplitter::splitterMoved, this, [this] { upper_->setSizes(lower_->sizes()); });
  vertical_place_->installEventFilter(this);
}

// The legend follows every change of its width.
bool ViewerArea::eventFilter(QObject* watched, QEvent* event) {
  const bool is_sized = event->type() == QEvent::Resize || event->type() == QEvent::Show;
  if (watched == vertical_place_ && is_sized) {
    QMetaObject::invokeMethod(
        this, [this] { align(*lower_, *upper_, *vertical_place_); }, Qt::QueuedConnection);
  }
  return QWidget::eventFilter(watched, event);
}

void ViewerArea::addPanesTo(Panes& panes) {
  const auto add = [&panes](const QString& id, EpiPane* pane, QWidget* place) {
    panes.add({id, pane->accessibleName(), pane, [pane, place] {
                 place->layout()->addWidget(pane);
                 pane->show();
               }});
  };
  add("epi.horizontal", horizontal_epi_, horizontal_place_);
  add("epi.vertical", vertical_epi_, vertical_place_);
  connect(&panes, &Panes::changed, this, &ViewerArea::fitPlaces);
}

// The horizontal EPI is as wide as the view: the legend moves below where nothing is above it.
void ViewerArea::fitPlaces() {
  const bool has_vertical = vertical_place_->isAncestorOf(vertical_epi_);
  vertical_epi_->setMayLie(!has_vertical);
  vertical_place_->setVisible(has_vertical && center_->currentWidget() == canvas_);
  horizontal_place_->setVisible(horizontal_place_->isAncestorOf(horizontal_epi_));
  QSplitter* legend_place = has_vertical ? lower_ : rows_;
  if (legend_->parentWidget() != legend_place) {
    const int epi_height = rows_->sizes()[1], legend_height = legend_->sizeHint().height();
    legend_place->addWidget(legend_);
    if (!has_vertical) {
      rows_->setSizes({rows_->height() - epi_height - legend_height, epi_height, legend_height});
    }
  }
  lower_->setVisible(has_vertical || !horizontal_place_->isHidden());
}

void ViewerArea::showInCenter(QWidget* widget) {
  const bool has_focus = canvas_->hasFocus() || wall_->hasFocus() ||
                         wall_->isAncestorOf(QApplication::focusWidget()) ||
                         (guest_ && (guest_ == QApplication::focusWidget() ||
                                     guest_->isAncestorOf(QApplication::focusWidget())));
  center_->setCurrentWidget(widget);
  fitPlaces();
  if (has_focus) widget->setFocus();
}

void ViewerArea::setWallShown(bool is_shown) {
  const bool is_new = !std::exchange(is_wall_shown_, is_shown) && is_shown;
  if (guest_ && is_new) emit guestDismissed();
  if (!guest_) showInCenter(is_shown ? static_cast<QWidget*>(wall_) : canvas_);
}

void ViewerArea::setGuest(QWidget* guest) {
  center_->addWidget(guest);
  guest_ = guest;
  showInCenter(guest);
}

void ViewerArea::releaseGuest() {
  if (!guest_) return;
  showInCenter(is_wall_shown_ ? static_cast<QWidget*>(wall_) : canvas_);
  center_->removeWidget(guest_);
  guest_->hide();
  guest_ = nullptr;
}

QWidget* ViewerArea::keyboardHome() const {
  return guest_ ? guest_.data() : activeCanvas();
}

ViewCanvas* ViewerArea::activeCanvas() const {
  return isWallShown() && wall_->active() ? wall_->active() : canvas_;
}

QRect ViewerArea::pixelsInSight() const {
  return activeCanvas()->visiblePixels();
}

void ViewerArea::showPreview(const QImage& picture, const QString& caption) {
  canvas_->setOverlay({});
  canvas_->setScribbles({});
  canvas_->setCrossHair(std::nullopt);
  for (EpiPane* pane : {horizontal_epi_, vertical_epi_}) {
    pane->setEpi({});
    pane->setCrossHair(std::nullopt, 0);
    pane->clearMeasurement();
  }
  canvas_->setPicture(picture);
  canvas_->setCaption(caption);
  if (!std::exchange(is_previewing_, true)) emit previewChanged(true);
}

void ViewerArea::showPreviewEpis(const QImage& horizontal, const QImage& vertical) {
  if (!is_previewing_) return;
  horizontal_epi_->setEpi(horizontal);
  vertical_epi_->setEpi(vertical);
}

QString open_a_light_field() {
  return ViewerArea::tr("Open a light field first.");
}

QString why_nothing_runs(const Session& session, const ViewerArea& area) {
  if (!session.scene()) return open_a_light_field();
  if (!area.isPreviewing()) return {};
  return ViewerArea::tr("The light field is still loading.");
}

}  // namespace episcope

#include "moc_viewer_area.cpp"
