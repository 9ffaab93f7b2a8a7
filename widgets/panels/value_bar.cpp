// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/value_bar.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QGridLayout>
#include <QPixmap>
#include <QPushButton>
#include <QSlider>

#include <cmath>

namespace episcope {
namespace {

constexpr int kSwatch = 12;

QString signed_number(double value) {
  const QString text = number_text(value);
  return text.toDouble() > 0 ? '+' + text : text;
}

QString with_error(double disparity_px, std::optional<double> truth_px) {
  const QString text = number_text(disparity_px);
  return truth_px ? QString("%1 (%2)").arg(text, signed_number(disparity_px - *truth_px)) : text;
}

QString estimate_text(const EstimateReading& estimate, const PixelReading& reading) {
  if (!estimate.disparity_px) return ValueBar::tr("%1 invalid").arg(estimate.name);
  QString text = estimate.name + ' ' + with_error(*estimate.disparity_px, reading.truth_px);
  if (estimate.background_px) {
    text += ValueBar::tr(", behind %1")
                .arg(with_error(*estimate.background_px, reading.background_truth_px));
  }
  return text;
}

QStringList reading_parts(const PixelReading& reading) {
  QStringList parts{ValueBar::tr("x %1 y %2").arg(reading.pixel.x).arg(reading.pixel.y)};
  if (!reading.samples.isEmpty()) {
    const bool is_rgb = reading.samples.contains(' ');
    parts << (is_rgb ? ValueBar::tr("rgb %1") : ValueBar::tr("grey %1")).arg(reading.samples);
  }
  parts << reading.labels;
  if (reading.has_truth) {
    parts << (reading.truth_px ? ValueBar::tr("ground truth %1").arg(number_text(*reading.truth_px))
                               : ValueBar::tr("no ground truth here"));
    if (reading.background_truth_px) {
      parts.back() += ValueBar::tr(", behind %1").arg(number_text(*reading.background_truth_px));
    }
  }
  for (const auto& estimate : reading.estimates) parts << estimate_text(estimate, reading);
  return parts;
}

}  // namespace

ValueBar::ValueBar(QWidget* parent)
    : QWidget(parent),
      swatch_(named("valueBar.swatch", new QLabel(this))),
      values_(named("valueBar.values", new PartsLabel(this))),
      status_(named("valueBar.status", new QLabel(this))) {
  setObjectName("valueBar");
  swatch_->setFixedSize(kSwatch, kSwatch);
  make_row(this, {swatch_, {values_, 1}, status_},
           {.margins = {theme::kMargin, 2, theme::kMargin, 2}, .spacing = theme::kSpacing});
  setReading(std::nullopt);
  theme::follow_palette(this, this, [this] { updateColors(); });
}

void ValueBar::setReading(const std::optional<PixelReading>& reading) {
  values_->setParts(reading ? reading_parts(*reading)
                            : QStringList(tr("Move over the view to read its values")));
  QPixmap swatch(kSwatch, kSwatch);
  swatch.fill(reading && reading->color.isValid() ? reading->color : QColor(Qt::transparent));
  swatch_->setPixmap(swatch);
  has_reading_ = reading.has_value();
  updateColors();
}

void ValueBar::updateColors() {
  values_->setPalette(has_reading_ ? QPalette()
                                   : theme::text_palette(theme::muted_text(palette())));
}

namespace {

constexpr double kSliderStep = 0.01;
constexpr int kButtonRow = 3;

int tone_step(double value) {
  return static_cast<int>(std::lround(value / kSliderStep));
}

}  // namespace

TonePanel::TonePanel(QWidget* parent) : QWidget(parent) {
  setObjectName("tonePanel");
  new QGridLayout(this);
  exposure_ = addRow(0, {"tone.exposure", tr("Exposure"), tr("Each stop doubles the brightness"),
                         render::kExposureRange, tr(" stops")});
  gamma_ = addRow(
      1, {"tone.gamma", tr("Gamma"), tr("More than 1 lifts the shadows"), render::kGammaRange, {}});
  black_ = addRow(2, {"tone.black",
                      tr("Black point"),
                      tr("Darker values are shown as black; 1 is white"),
                      render::kBlackRange,
                      {}});
  addButtons();
  addReach();
  setTone({});
}

TonePanel::Row TonePanel::addRow(int place, const Quality& quality) {
  auto* layout = qobject_cast<QGridLayout*>(this->layout());
  const Row row{new QSlider(Qt::Horizontal, this), new NumberSpin(this)};
  auto* label = new QLabel(quality.text, this);
  label->setBuddy(row.field);
  row.slider->setObjectName(QString("%1.slider").arg(quality.name));
  row.slider->setAccessibleName(quality.text);
  row.slider->setRange(tone_step(quality.range.min), tone_step(quality.range.max));
  row.field->setObjectName(quality.name);
  row.field->setDecimals(2);
  row.field->setSingleStep(0.05);
  row.field->setRange(quality.range.min, quality.range.max);
  row.field->setSuffix(quality.suffix);
  row.field->setToolTip(quality.tip);
  row.slider->setToolTip(quality.tip);
  layout->addWidget(label, place, 0);
  layout->addWidget(row.slider, place, 1);
  layout->addWidget(row.field, place, 2);
  connect(row.slider, &QSlider::valueChanged, this, [this, row](int value) {
    Quietly(row.field)->setValue(value * kSliderStep);
    emit toneEdited(tone());
  });
  connect(row.field, &NumberSpin::valueChanged, this, [this, row](double value) {
    Quietly(row.slider)->setValue(tone_step(value));
    emit toneEdited(tone());
  });
  return row;
}

void TonePanel::addButtons() {
  auto* layout = qobject_cast<QGridLayout*>(this->layout());
  auto* automatic = named("tone.automatic", new QPushButton(tr("Automatic"), this));
  automatic->setToolTip(tr("Shows the whole brightness range of this view"));
  auto* reset = named("tone.reset", new QPushButton(tr("Reset"), this));
  reset->setToolTip(tr("Shows samples as they are"));
  layout->addWidget(automatic, kButtonRow, 1);
  layout->addWidget(reset, kButtonRow, 2);
  connect(automatic, &QPushButton::clicked, this, &TonePanel::automaticRequested);
  connect(reset, &QPushButton::clicked, this, [this] {
    setTone({});
    emit toneEdited({});
  });
}

void TonePanel::addReach() {
  auto* reach = named(
      "tone.reach",
      new QLabel(tr("Brightens views, EPIs, tiles, the points of the 3D tab, and saved pictures "
                    "and movies. "
                    "Results, labels, PLY files and converted light fields keep the samples."),
                 this));
  reach->setTextFormat(Qt::PlainText);
  reach->setWordWrap(true);
  theme::mute(reach);
  qobject_cast<QGridLayout*>(layout())->addWidget(reach, kButtonRow + 1, 0, 1, 3);
}

void TonePanel::showRow(const Row& row, double value) {
  Quietly(row.slider)->setValue(tone_step(value));
  Quietly(row.field)->setValue(value);
}

void TonePanel::setTone(const render::Tone& shown) {
  if (shown == tone()) return;
  showRow(exposure_, shown.exposure);
  showRow(gamma_, shown.gamma);
  showRow(black_, shown.black);
}

render::Tone TonePanel::tone() const {
  return {.black = black_.field->value(),
          .exposure = exposure_.field->value(),
          .gamma = gamma_.field->value()};
}

}  // namespace episcope

#include "moc_value_bar.cpp"
