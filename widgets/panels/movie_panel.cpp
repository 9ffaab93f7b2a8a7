// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/movie_panel.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QSpinBox>

namespace episcope {
namespace {

using render::CameraPath;
using render::MovieKind;

constexpr double kFarthestFocus_px = 20;

}  // namespace

MoviePanel::MoviePanel(QWidget* parent)
    : QWidget(parent),
      kind_(named("movie.kind", new QComboBox(this))),
      path_(named("movie.path", new QComboBox(this))),
      nearest_(named("movie.focusTo", new NumberSpin(this))),
      farthest_(named("movie.focusFrom", new NumberSpin(this))),
      seconds_(named("movie.seconds", new NumberSpin(this))),
      width_(named("movie.width", new QSpinBox(this))),
      overlay_(named("movie.overlay", new QCheckBox(tr("With the overlay of the view"), this))) {
  setObjectName("moviePanel");
  auto* form = new QFormLayout(this);
  addKinds(*form);
  addFocus(*form);
  addSizes(*form);
  overlay_->setChecked(true);
  form->addRow(QString(), overlay_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->button(QDialogButtonBox::Cancel)->setObjectName("movie.cancel");
  QPushButton* save = buttons->addButton(tr("Save…"), QDialogButtonBox::AcceptRole);
  save->setObjectName("movie.save");
  save->setDefault(true);
  form->addRow(buttons);
  connect(buttons, &QDialogButtonBox::accepted, this, &MoviePanel::saveRequested);
  connect(buttons, &QDialogButtonBox::rejected, this, &MoviePanel::cancelRequested);
  connect(kind_, &QComboBox::currentIndexChanged, this, &MoviePanel::adapt);
  adapt();
}

void MoviePanel::addKinds(QFormLayout& form) {
  kind_->addItem(tr("Parallax: the view moves"), static_cast<int>(MovieKind::Parallax));
  kind_->addItem(tr("Refocusing: the focus plane moves"), static_cast<int>(MovieKind::Refocus));
  kind_->addItem(tr("Flip: A and B alternate"), static_cast<int>(MovieKind::Flip));
  path_->addItem(tr("Around the center"), static_cast<int>(CameraPath::Circle));
  path_->addItem(tr("Along the row of the center"), static_cast<int>(CameraPath::Swing));
  path_->addItem(tr("Through all views"), static_cast<int>(CameraPath::Snake));
  form.addRow(tr("What changes"), kind_);
  form.addRow(tr("Path"), path_);
}

void MoviePanel::addFocus(QFormLayout& form) {
  farthest_->setAccessibleName(tr("Focus from"));
  nearest_->setAccessibleName(tr("Focus to"));
  for (NumberSpin* each : {farthest_, nearest_}) {
    each->setDecimals(2);
    each->setSingleStep(0.1);
    each->setRange(-kFarthestFocus_px, kFarthestFocus_px);
    each->setSuffix(tr(" px"));
    each->setToolTip(tr("Disparity in focus at one end of the movement"));
  }
  auto* row = make_row({{farthest_, 1}, new QLabel(tr("to"), this), {nearest_, 1}});
  form.addRow(tr("Focus from"), row);
}

void MoviePanel::addSizes(QFormLayout& form) {
  seconds_->setDecimals(1);
  seconds_->setRange(render::kMovieSeconds.min, render::kMovieSeconds.max);
  seconds_->setSuffix(tr(" s"));
  seconds_->setValue(render::MovieChoice().seconds);
  width_->setRange(0, render::kWidestMovie_px);
  width_->setSingleStep(64);
  width_->setSuffix(tr(" px"));
  width_->setSpecialValueText(tr("as the views"));
  form.addRow(tr("Duration"), seconds_);
  form.addRow(tr("Width"), width_);
}

void MoviePanel::setAvailable(const std::set<MovieKind>& kinds) {
  for (int i = 0; i < kind_->count(); ++i) {
    const auto kind = static_cast<MovieKind>(kind_->itemData(i).toInt());
    set_item_enabled(kind_, i, kinds.contains(kind));
    if (i == kind_->currentIndex() && !kinds.contains(kind)) kind_->setCurrentIndex(0);
  }
}

void MoviePanel::setOverlayAvailable(bool is_available) {
  has_overlay_ = is_available;
  adapt();
}

void MoviePanel::setFocusRange(Interval range_px) {
  farthest_->setValue(range_px.min);
  nearest_->setValue(range_px.max);
}

render::MovieChoice MoviePanel::choice() const {
  return {.kind = static_cast<MovieKind>(kind_->currentData().toInt()),
          .path = static_cast<CameraPath>(path_->currentData().toInt()),
          .focus_px = {farthest_->value(), nearest_->value()},
          .seconds = seconds_->value(),
          .width_px = width_->value()};
}

void MoviePanel::adapt() {
  const MovieKind kind = choice().kind;
  path_->setEnabled(kind == MovieKind::Parallax);
  for (NumberSpin* each : {farthest_, nearest_}) each->setEnabled(kind == MovieKind::Refocus);
  overlay_->setEnabled(kind == MovieKind::Parallax && has_overlay_);
}

}  // namespace episcope

#include "moc_movie_panel.cpp"
