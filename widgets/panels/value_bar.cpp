// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/value_bar.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPixmap>

namespace episcope {
namespace {

constexpr int kSwatch = 12;

QString signed_number(double value) {
  const QString text = number_text(value);
  return text.front().isDigit() ? '+' + text : text;
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
  if (reading.has_truth) {
    parts << (reading.truth_px ? ValueBar::tr("truth %1").arg(number_text(*reading.truth_px))
                               : ValueBar::tr("no truth here"));
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
      swatch_(new QLabel(this)),
      values_(new PartsLabel(this)),
      status_(new QLabel(this)) {
  setObjectName("valueBar");
  swatch_->setObjectName("valueBar.swatch");
  swatch_->setFixedSize(kSwatch, kSwatch);
  values_->setObjectName("valueBar.values");
  status_->setObjectName("valueBar.status");
  auto* layout = new QHBoxLayout(this);
  layout->setContentsMargins(theme::kMargin, 2, theme::kMargin, 2);
  layout->setSpacing(theme::kSpacing);
  layout->addWidget(swatch_);
  layout->addWidget(values_, 1);
  layout->addWidget(status_);
  setReading(std::nullopt);
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

void ValueBar::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) updateColors();
}

void ValueBar::updateColors() {
  values_->setPalette(has_reading_ ? QPalette()
                                   : theme::text_palette(theme::muted_text(palette())));
}

void ValueBar::setStatus(const QString& status) {
  status_->setText(status);
}

QString ValueBar::text() const {
  return values_->fullText();
}

}  // namespace episcope

#include "moc_value_bar.cpp"
