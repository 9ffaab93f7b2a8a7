// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/stage/stage.h"

#include "widgets/browse/epi_pane.h"
#include "widgets/canvas/tile_wall.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/compare/color_bar.h"
#include "widgets/compare/overlay_bar.h"
#include "widgets/style/theme.h"

#include <QApplication>
#include <QGridLayout>
#include <QVBoxLayout>

#include <utility>

namespace episcope {
namespace {

constexpr int kEpiWidth = 145;  // of the vertical EPI and the legend under it

QWidget* make_legend(ColorBar* color_bar, QWidget* parent) {
  // Its place is kept while nothing is drawn over the view, so that the view does not jump.
  QSizePolicy policy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  policy.setRetainSizeWhenHidden(true);
  color_bar->setSizePolicy(policy);
  auto* legend = new QWidget(parent);
  auto* layout = new QVBoxLayout(legend);
  layout->setContentsMargins(theme::kSpacing, 0, theme::kSpacing, 0);
  layout->addStretch(1);
  layout->addWidget(color_bar);
  layout->addStretch(1);
  return legend;
}

}  // namespace

Stage::Stage(QWidget* parent)
    : QWidget(parent),
      canvas_(new ViewCanvas(this)),
      wall_(new TileWall(this)),
      horizontal_epi_(new EpiPane(Qt::Horizontal, this)),
      vertical_epi_(new EpiPane(Qt::Vertical, this)),
      color_bar_(new ColorBar(this)),
      overlay_bar_(new OverlayBar(this)) {
  wall_->hide();
  overlay_bar_->setSelectorVisible(false);  // the tool bar has a button for each
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(2);
  layout->addWidget(canvas_, 0, 0);
  layout->addWidget(wall_, 0, 0, 1, 2);
  layout->addWidget(vertical_epi_, 0, 1);
  layout->addWidget(horizontal_epi_, 1, 0);
  layout->addWidget(make_legend(color_bar_, this), 1, 1);
  layout->setColumnMinimumWidth(1, kEpiWidth);
  layout->setColumnStretch(0, 12);
  layout->setColumnStretch(1, 1);
  layout->setRowStretch(0, 12);
  layout->setRowStretch(1, 1);
}

void Stage::setWallShown(bool is_shown) {
  const bool has_focus =
      canvas_->hasFocus() || wall_->hasFocus() || wall_->isAncestorOf(QApplication::focusWidget());
  wall_->setVisible(is_shown);
  if (has_focus && is_shown) wall_->setFocus();
  canvas_->setVisible(!is_shown);
  vertical_epi_->setVisible(!is_shown);
  if (has_focus && !is_shown) canvas_->setFocus();
}

bool Stage::isWallShown() const {
  return wall_->isVisibleTo(this);
}

ViewCanvas* Stage::activeCanvas() const {
  return isWallShown() && wall_->active() ? wall_->active() : canvas_;
}

QRect Stage::pixelsInSight() const {
  return activeCanvas()->visiblePixels();
}

void Stage::showPreview(const QImage& picture, const QString& caption) {
  canvas_->setOverlay({});
  canvas_->setScribbles({});
  canvas_->setCrossHair(std::nullopt);
  horizontal_epi_->setEpi({});
  vertical_epi_->setEpi({});
  canvas_->setPicture(picture);
  canvas_->setCaption(caption);
  if (!std::exchange(is_previewing_, true)) emit previewChanged(true);
}

void Stage::endPreview() {
  if (std::exchange(is_previewing_, false)) emit previewChanged(false);
}

}  // namespace episcope

#include "moc_stage.cpp"
