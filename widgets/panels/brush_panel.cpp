// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/brush_panel.h"

#include "annotation/brush.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QSpinBox>
#include <QToolButton>

#include <cmath>

namespace episcope {
namespace {

constexpr double kFirstTolerance = 8;
constexpr double kMostTolerance = 500;
constexpr int kFirstOpacity = 70;

}  // namespace

BrushPanel::BrushPanel(QWidget* parent)
    : QWidget(parent),
      buttons_(make_row({kRoom}, {.spacing = 2})),
      protects_(named("brush.protect", new QCheckBox(tr("Protect other labels"), this))),
      bound_(named("fill.bound", new QComboBox(this))),
      tolerance_(named("fill.tolerance", new QDoubleSpinBox(this))),
      opacity_(named("brush.opacity", new QSlider(Qt::Horizontal, this))) {
  setObjectName("brushPanel");
  auto* form = new QFormLayout;
  form->setContentsMargins(0, 0, 0, 0);
  form->setSpacing(theme::kSpacing);
  form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  brush_ = addSize(*form, "brush", tr("Brush"), &BrushPanel::brushSizeEdited);
  eraser_ = addSize(*form, "eraser", tr("Eraser"), &BrushPanel::eraserSizeEdited);
  setSizeKeys({});
  addFill(*form);
  opacity_->setRange(0, 100);
  opacity_->setValue(kFirstOpacity);
  opacity_->setToolTip(tr("Opacity of painted labels"));
  form->addRow(tr("Opacity"), opacity_);
  protects_->setToolTip(
      tr("The brush paints only unpainted pixels, and the eraser erases only the current label. "
         "Hold Shift for a single stroke of this kind."));
  make_column(this, {buttons_, form, protects_},
              {.margins = {0, theme::kSpacing, 0, 0}, .spacing = theme::kSpacing});
  connect(protects_, &QCheckBox::toggled, this, &BrushPanel::protectsOthersEdited);
  connect(opacity_, &QSlider::valueChanged, this,
          [this] { emit scribbleOpacityEdited(scribbleOpacity()); });
}

BrushPanel::SizeRow BrushPanel::addSize(QFormLayout& form, const QString& name, const QString& text,
                                        void (BrushPanel::*edited)(double)) {
  const SizeRow row{new QSlider(Qt::Horizontal, this), new QSpinBox(this)};
  row.slider->setObjectName(name + ".slider");
  row.spin->setObjectName(name + ".spin");
  row.slider->setAccessibleName(text);
  row.spin->setAccessibleName(text);
  row.slider->setRange(static_cast<int>(kMinBrush_px), static_cast<int>(kMaxBrush_px));
  row.spin->setRange(static_cast<int>(kMinBrush_px), static_cast<int>(kMaxBrush_px));
  row.spin->setSuffix(tr(" px"));
  row.spin->setKeyboardTracking(false);
  auto* line = make_row({{row.slider, 1}, row.spin}, {.spacing = theme::kSpacing});
  form.addRow(text, line);
  connect(row.slider, &QSlider::valueChanged, row.spin, &QSpinBox::setValue);
  connect(row.spin, &QSpinBox::valueChanged, this, [this, row, edited](int diameter_px) {
    Quietly(row.slider)->setValue(diameter_px);
    emit(this->*edited)(diameter_px);
  });
  return row;
}

void BrushPanel::addFill(QFormLayout& form) {
  bound_->addItem(tr("like colors"), static_cast<int>(FillBound::Likeness));
  bound_->addItem(tr("its segment"), static_cast<int>(FillBound::Segmentation));
  bound_->setToolTip(
      tr("Limits of a fill: pixels of like color on one surface, or the segment of the current "
         "segmentation"));
  tolerance_->setLocale(QLocale::c());
  tolerance_->setRange(0, kMostTolerance);
  tolerance_->setDecimals(1);
  tolerance_->setSuffix(tr(" × noise"));
  tolerance_->setValue(kFirstTolerance);
  tolerance_->setToolTip(
      tr("How much colors may differ from the color under the cursor, in units of what neighboring "
         "pixels of this view differ by. Drag to the right or left while filling to change it."));
  auto* line = make_row({{bound_, 1}, tolerance_}, {.spacing = theme::kSpacing});
  form.addRow(tr("Fill"), line);
  setSegmentationAvailable(false);
}

void BrushPanel::setSize(const SizeRow& row, double diameter_px) {
  Quietly(row.slider)->setValue(static_cast<int>(std::lround(diameter_px)));
  Quietly(row.spin)->setValue(static_cast<int>(std::lround(diameter_px)));
}

void BrushPanel::setSizeKeys(const QString& keys) {
  const QString tip =
      tr("Diameter in pixels of the view (%1)")
          .arg(keys.isEmpty() ? tr("Ctrl+Shift+wheel") : tr("%1, or Ctrl+Shift+wheel").arg(keys));
  for (const SizeRow& row : {brush_, eraser_}) {
    row.slider->setToolTip(tip);
    row.spin->setToolTip(tip);
  }
}

void BrushPanel::setSegmentationAvailable(bool is_available) {
  set_item_enabled(bound_, 1, is_available);
  if (!is_available) bound_->setCurrentIndex(0);
}

FillBound BrushPanel::fillBound() const {
  return static_cast<FillBound>(bound_->currentData().toInt());
}

AnnotationBar::AnnotationBar(QWidget* parent)
    : QWidget(parent),
      carried_(named("carry.on", new QCheckBox(tr("Propagate to all views by"), this))),
      by_(named("carry.by", new QComboBox(this))),
      carry_state_(named("carry.state", new ElidedLabel(this))),
      file_state_(named("annotation.file", new ElidedLabel(this, Qt::ElideMiddle))),
      buttons_(make_row({{file_state_, 1}}, {.spacing = 2})) {
  setObjectName("annotationBar");
  carried_->setToolTip(
      tr("Shows the scribbles of every view on all others, as stripes: propagated along rays, "
         "except where they are occluded. They never replace what you painted."));
  by_->addItem(tr("the shown estimate"), static_cast<int>(CarriedBy::Estimate));
  by_->addItem(tr("the ground truth"), static_cast<int>(CarriedBy::Truth));
  by_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  by_->setToolTip(tr("Disparity along which scribbles are propagated"));
  auto* carry = make_row({carried_, {by_, 1}}, {.spacing = theme::kSpacing});
  make_column(this, {carry, carry_state_, buttons_},
              {.margins = {0, 0, 0, theme::kSpacing}, .spacing = 4});
  connect(carried_, &QCheckBox::toggled, this, &AnnotationBar::carriedEdited);
  connect(by_, &QComboBox::activated, this, [this] {
    is_chosen_ = true;
    emit carriedByEdited();
  });
  setSources(false, false);
  setCarryState({});
}

void AnnotationBar::setSources(bool has_estimate, bool has_truth) {
  const bool has[] = {has_estimate, has_truth};
  for (int i = 0; i < 2; ++i) set_item_enabled(by_, i, has[i]);
  const int wanted = is_chosen_ ? by_->currentIndex() : 0;
  by_->setCurrentIndex(has[wanted] || !has[1 - wanted] ? wanted : 1 - wanted);
  by_->setEnabled(has_estimate || has_truth);
}

void AnnotationBar::setCarryState(const QString& state) {
  carry_state_->setFullText(state);
  carry_state_->setVisible(!state.isEmpty());
}

AnnotationBar::CarriedBy AnnotationBar::carriedBy() const {
  return static_cast<CarriedBy>(by_->currentData().toInt());
}

}  // namespace episcope

#include "moc_brush_panel.cpp"
