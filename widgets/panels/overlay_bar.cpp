// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/overlay_bar.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

constexpr double kFocusStep = 0.01;  // px a slider step.
constexpr int kMostQuantities = 20;  // seen at once

int focus_step(double focus_px) {
  return static_cast<int>(std::lround(focus_px / kFocusStep));
}

}  // namespace

OverlayBar::OverlayBar(QWidget* parent)
    : QWidget(parent),
      quantity_(named("overlay.quantity", new QComboBox(this))),
      opacity_(named("overlay.opacity", new QSlider(Qt::Horizontal, this))),
      focus_slider_(named("overlay.focusSlider", new QSlider(Qt::Horizontal, this))),
      focus_spin_(named("overlay.focusSpin", new NumberSpin(this))),
      row_(new QHBoxLayout(this)) {
  setObjectName("overlayBar");
  quantity_->setAccessibleName(tr("Map over the view"));
  quantity_->setToolTip(tr("Map over the view (M: next)"));
  // Wide enough for each, so that nothing moves.
  for (const render::QuantityInfo& each : render::quantities()) {
    quantity_->addItem(quantity_button(each.quantity));
  }
  quantity_->setFixedWidth(quantity_->sizeHint().width());
  quantity_->setMaxVisibleItems(kMostQuantities);
  opacity_->setRange(0, 100);
  opacity_->setMinimumWidth(30);
  opacity_->setMaximumWidth(70);
  opacity_->setToolTip(tr("Opacity of the overlay"));
  focus_slider_->setMinimumWidth(34);
  focus_slider_->setMaximumWidth(220);
  focus_slider_->setToolTip(
      tr("Focus plane: shears EPIs and view so that this disparity appears as zero (Alt+wheel, "
         "Ctrl+wheel, "
         "Shift+click)"));
  focus_spin_->setAccessibleName(tr("Focus plane"));
  focus_spin_->setDecimals(2);
  focus_spin_->setSingleStep(0.05);
  focus_spin_->setRange(-kFarthestFocus, kFarthestFocus);
  focus_spin_->setSuffix(tr(" px"));
  auto* reset =
      make_tool_button({"overlay.focusReset", "reset", tr("Reset the focus plane to 0 px")}, this);

  row_->setContentsMargins(0, 0, 0, 0);
  row_->setSpacing(theme::kSpacing);
  auto* map = new QLabel(tr("Map"), this);
  map->setBuddy(quantity_);
  row_->addWidget(map);
  row_->addWidget(quantity_);
  row_->addWidget(opacity_);
  row_->addSpacing(theme::kMargin);
  row_->addWidget(new QLabel(tr("Focus"), this));
  row_->addWidget(focus_slider_, 1);
  row_->addWidget(focus_spin_);
  row_->addWidget(reset);
  row_->addStretch();
  for (auto* label : findChildren<QLabel*>()) {
    label->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Preferred);
  }
  quantity_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  focus_spin_->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);

  setOpacity(0.7);
  setFocusRange({-2, 2});
  setAvailable({});
  connect(quantity_, &QComboBox::activated, this, [this] {
    opacity_->setEnabled(quantity() != Quantity::View);
    emit quantitySelected(quantity());
  });
  connect(opacity_, &QSlider::valueChanged, this, [this] { emit opacityChanged(opacity()); });
  connect(focus_slider_, &QSlider::valueChanged, this,
          [this](int value) { changeFocus(value * kFocusStep); });
  connect(focus_spin_, &NumberSpin::valueChanged, this, &OverlayBar::changeFocus);
  connect(reset, &QToolButton::clicked, this, [this] { changeFocus(0); });
}

void OverlayBar::setAvailable(const std::vector<Quantity>& quantities) {
  std::vector<Quantity> listed{Quantity::View};
  std::ranges::copy_if(quantities, std::back_inserter(listed),
                       [](Quantity each) { return each != Quantity::View; });
  if (listed == listed_) return;  // its list may be open
  listed_ = std::move(listed);
  const Quantity shown = quantity();
  const QSignalBlocker blocker(quantity_);
  quantity_->clear();
  for (const Quantity each : listed_) {
    quantity_->addItem(quantity_button(each), static_cast<int>(each));
    quantity_->setItemData(quantity_->count() - 1, quantity_tip(each), Qt::ToolTipRole);
  }
  quantity_->setCurrentIndex(std::max(0, quantity_->findData(static_cast<int>(shown))));
}

void OverlayBar::setQuantity(Quantity quantity) {
  const int place = quantity_->findData(static_cast<int>(quantity));
  if (place < 0) return;
  Quietly(quantity_)->setCurrentIndex(place);
  opacity_->setEnabled(quantity != Quantity::View);
}

void OverlayBar::setOpacity(double opacity) {
  Quietly(opacity_)->setValue(static_cast<int>(std::lround(100 * opacity)));
}

void OverlayBar::setFocusRange(Interval range_px) {
  const QSignalBlocker slider_blocker(focus_slider_);
  // Zero, the plane of the files, is always within reach, and so is what is in focus.
  const double min = std::min({0.0, focus(), range_px.min});
  const double max = std::max({0.0, focus(), range_px.max});
  focus_slider_->setRange(focus_step(min), focus_step(max));
  focus_slider_->setPageStep(10);
}

void OverlayBar::addOpacityAction(QAction* action) {
  row_->insertWidget(row_->indexOf(opacity_) + 1, make_action_button(action, this));
}

void OverlayBar::showFocus(double focus_px) {
  const QSignalBlocker slider_blocker(focus_slider_);
  const QSignalBlocker spin_blocker(focus_spin_);
  const int place = focus_step(focus_px);
  focus_slider_->setRange(std::min(focus_slider_->minimum(), place),
                          std::max(focus_slider_->maximum(), place));
  focus_slider_->setValue(place);
  focus_spin_->setValue(focus_px);
}

void OverlayBar::changeFocus(double focus_px) {
  showFocus(focus_px);
  emit focusChanged(focus());
}

Quantity OverlayBar::quantity() const {
  return static_cast<Quantity>(quantity_->currentData().toInt());
}

void OverlayBar::selectNextQuantity() {
  const int next = (quantity_->currentIndex() + 1) % quantity_->count();
  setQuantity(listed_[static_cast<std::size_t>(next)]);
  emit quantitySelected(quantity());
}

namespace {

QComboBox* make_combo(const char* name, const QString& tip, QWidget* parent) {
  auto* combo = named(name, new QComboBox(parent));
  combo->setToolTip(tip);
  combo->setAccessibleName(tip);
  combo->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  combo->setMinimumWidth(90);
  combo->setMaxVisibleItems(20);
  return combo;
}

QLabel* make_badge(Side side, QWidget* parent) {
  auto* badge = new QLabel(parent);
  badge->setPixmap(side_icon(side).pixmap(18, 18));
  badge->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  return badge;
}

void fill(QComboBox* combo, const std::vector<CompareBar::Choice>& choices, quint64 current,
          const QString& placeholder) {
  const QSignalBlocker blocker(combo);
  combo->clear();
  combo->setToolTip(combo->accessibleName());
  for (const auto& choice : choices) {
    const bool is_warned = !choice.warning.isEmpty();
    const QString tip = is_warned ? choice.name + '\n' + choice.warning : choice.name;
    combo->addItem(is_warned ? warned_name(choice.name) : choice.name, choice.id);
    combo->setItemData(combo->count() - 1, tip, Qt::ToolTipRole);
    if (is_warned && choice.id == current) combo->setToolTip(tip);
  }
  combo->setPlaceholderText(placeholder);
  combo->setCurrentIndex(combo->findData(current));
}

}  // namespace

CompareBar::CompareBar(QWidget* parent)
    : QWidget(parent),
      a_(make_combo("compare.a", tr("A: the result shown"), this)),
      b_(make_combo("compare.b", tr("B: the result it is compared with"), this)),
      maps_(make_row({new QLabel(tr("Map"), this), kRoom}, {.spacing = 2})),
      buttons_(make_row({kRoom}, {.spacing = 2})) {
  setObjectName("compareBar");
  auto* row = make_row({make_badge(Side::A, this), {a_, 1}}, {.spacing = theme::kSpacing});
  row->addSpacing(theme::kSpacing);
  row->addWidget(make_badge(Side::B, this));
  row->addWidget(b_, 1);
  make_column(this, {row, maps_, buttons_},
              {.margins = {0, theme::kSpacing, 0, 0}, .spacing = theme::kSpacing});
  connect(a_, &QComboBox::activated, this,
          [this] { emit aChosen(a_->currentData().toULongLong()); });
  connect(b_, &QComboBox::activated, this,
          [this] { emit bChosen(b_->currentData().toULongLong()); });
}

void CompareBar::setChoices(const std::vector<Choice>& choices, quint64 a, quint64 b,
                            const QString& other) {
  fill(a_, choices, a, tr("no result"));
  fill(b_, choices, b, other);
  a_->setEnabled(choices.size() > 1);
  b_->setEnabled(choices.size() > 1);
}

RegionBar::RegionBar(QWidget* parent)
    : QWidget(parent),
      part_(named("region.part", new QComboBox(this))),
      summary_(named("region.summary", new ElidedLabel(this))),
      layout_(new QHBoxLayout(this)) {
  setObjectName("regionBar");
  part_->setToolTip(tr("Pixels that the table and the plot evaluate"));
  part_->setAccessibleName(tr("Part of the view to evaluate on"));
  auto* label = new QLabel(tr("Evaluate on:"), this);
  label->setBuddy(part_);
  layout_->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout_->setSpacing(theme::kSpacing);
  layout_->addWidget(label);
  layout_->addWidget(part_);
  layout_->addWidget(summary_, 1);
  connect(part_, &QComboBox::activated, this, &RegionBar::partChosen);
}

void RegionBar::setParts(const QStringList& names) {
  const int current = part_->currentIndex();
  part_->clear();
  part_->addItems(names);
  part_->setCurrentIndex(current);
}

}  // namespace episcope

#include "moc_overlay_bar.cpp"
