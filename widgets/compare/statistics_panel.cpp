// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/compare/statistics_panel.h"

#include "widgets/compare/histogram_view.h"
#include "widgets/controls/elided_label.h"
#include "widgets/controls/number_spin.h"
#include "widgets/style/number_text.h"
#include "widgets/style/theme.h"

#include <QEvent>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QSignalBlocker>

#include <cstddef>

namespace episcope {
namespace {

constexpr double kLeastThreshold = 0.001;  // px
constexpr double kLargestThreshold = 10;

enum Number { kMin, kMedian, kMean, kMax, kBad, kInvalid };

constexpr const char* kNames[] = {QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "min"),
                                  QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "median"),
                                  QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "mean"),
                                  QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "max"),
                                  QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "bad"),
                                  QT_TRANSLATE_NOOP("episcope::StatisticsPanel", "invalid")};

}  // namespace

StatisticsPanel::StatisticsPanel(QWidget* parent)
    : QWidget(parent),
      title_(new ElidedLabel(this)),
      histogram_(new HistogramView(this)),
      threshold_(new NumberSpin(this)) {
  setObjectName("statisticsPanel");
  title_->setObjectName("statistics.title");
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, theme::kSpacing, 0, 0);
  layout->setVerticalSpacing(1);
  layout->setHorizontalSpacing(theme::kSpacing);
  layout->addWidget(title_, 0, 0, 1, static_cast<int>(names_.size()));
  layout->addWidget(histogram_, 1, 0, 1, static_cast<int>(names_.size()));
  for (int i = 0; i < static_cast<int>(names_.size()); ++i) {
    const auto place = static_cast<std::size_t>(i);
    names_[place] = new QLabel(tr(kNames[place]), this);
    values_[place] = new QLabel(this);
    values_[place]->setObjectName(QString("statistics.%1").arg(kNames[place]));
    layout->addWidget(names_[place], 2, i);
    layout->addWidget(values_[place], 3, i);
    layout->setColumnStretch(i, 1);
  }
  addThreshold(*layout);
  values_[kInvalid]->setToolTip(tr("Visible pixels without a value"));
  connect(histogram_, &HistogramView::rangeEdited, this, &StatisticsPanel::rangeEdited);
  clear(tr("No map is shown"));
}

void StatisticsPanel::addThreshold(QGridLayout& layout) {
  threshold_->setObjectName("statistics.threshold");
  threshold_->setRange(kLeastThreshold, kLargestThreshold);
  threshold_->setDecimals(3);
  threshold_->setLeastDecimals(2);
  threshold_->setSingleStep(0.01);
  threshold_->setKeyboardTracking(false);
  threshold_->setSuffix(tr(" px"));
  const QString tip = tr("Pixels whose error is larger are bad, on the map of bad pixels and here");
  threshold_->setToolTip(tip);
  auto* label = new QLabel(tr("Bad if off by more than"), this);
  label->setBuddy(threshold_);
  label->setToolTip(tip);
  values_[kBad]->setToolTip(tr("Visible judged pixels that are off by more than the threshold"));
  auto* row = new QHBoxLayout;
  row->setSpacing(theme::kSpacing);
  row->addWidget(label);
  row->addWidget(threshold_);
  row->addStretch(1);
  layout.addLayout(row, 4, 0, 1, static_cast<int>(names_.size()));
  connect(threshold_, &NumberSpin::valueChanged, this, &StatisticsPanel::badThresholdEdited);
}

void StatisticsPanel::setBadThreshold(double threshold_px) {
  const QSignalBlocker blocker(threshold_);
  threshold_->setValue(threshold_px);
}

void StatisticsPanel::setSummary(const Summary& summary) {
  const auto& statistics = summary.statistics;
  const QString title =
      summary.unit.isEmpty() ? summary.title : tr("%1 [%2]").arg(summary.title, summary.unit);
  title_->setFullText(tr("%1 · visible part").arg(title));
  histogram_->setHistogram(statistics.histogram, summary.shading);
  const double numbers[] = {statistics.min, statistics.median, statistics.mean, statistics.max};
  for (std::size_t i = 0; i < std::size(numbers); ++i) {
    values_[i]->setText(statistics.count == 0 ? QString("–") : number_text(numbers[i]));
  }
  values_[kBad]->setText(summary.bad_percent ? tr("%1 %").arg(*summary.bad_percent, 0, 'f', 2)
                                             : QString("–"));
  values_[kInvalid]->setText(QLocale::c().toString(static_cast<qulonglong>(statistics.invalid)));
  updateColors();
}

void StatisticsPanel::clear(const QString& why) {
  title_->setFullText(why);
  histogram_->setHistogram({}, {});
  for (QLabel* value : values_) value->setText("–");
  updateColors();
}

void StatisticsPanel::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) updateColors();
}

void StatisticsPanel::updateColors() {
  for (QLabel* name : names_) name->setPalette(theme::text_palette(theme::muted_text(palette())));
}

QString StatisticsPanel::text() const {
  QStringList texts;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    texts << names_[i]->text() + ' ' + values_[i]->text();
  }
  return texts.join(", ");
}

}  // namespace episcope

#include "moc_statistics_panel.cpp"
