// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/statistics_panel.h"

#include "widgets/controls/labels.h"
#include "widgets/controls/layout.h"
#include "widgets/controls/line_plot.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QGridLayout>
#include <QLabel>
#include <QLocale>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <cmath>
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
      threshold_(named("statistics.threshold", new NumberSpin(this))) {
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
    theme::mute(names_[place]);
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
  threshold_->setRange(kLeastThreshold, kLargestThreshold);
  threshold_->setDecimals(3);
  threshold_->setLeastDecimals(2);
  threshold_->setSingleStep(0.01);
  threshold_->setKeyboardTracking(false);
  threshold_->setSuffix(tr(" px"));
  const QString tip = tr("Pixels whose error is larger are bad, on the map of bad pixels and here");
  threshold_->setToolTip(tip);
  auto* label = new QLabel(tr("Bad-pixel threshold"), this);
  label->setBuddy(threshold_);
  label->setToolTip(tip);
  values_[kBad]->setToolTip(
      tr("Visible pixels that are off by more than the threshold, without the border of 15 px, "
         "which the table ignores, too"));
  auto* row = make_row({label, threshold_, kRoom}, {.spacing = theme::kSpacing});
  layout.addLayout(row, 4, 0, 1, static_cast<int>(names_.size()));
  bad_part_ = named("statistics.bad_part", new QLabel(this));
  bad_part_->setWordWrap(true);
  bad_part_->setText(tr("bad: of the visible part, without the border of 15 px"));
  theme::mute(bad_part_);
  layout.addWidget(bad_part_, 5, 0, 1, static_cast<int>(names_.size()));
  connect(threshold_, &NumberSpin::valueChanged, this, &StatisticsPanel::badThresholdEdited);
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
  bad_part_->setVisible(summary.bad_percent.has_value());
  values_[kInvalid]->setText(QLocale::c().toString(static_cast<qulonglong>(statistics.invalid)));
}

void StatisticsPanel::clear(const QString& why) {
  title_->setFullText(why);
  histogram_->setHistogram({}, {});
  for (QLabel* value : values_) value->setText("–");
  bad_part_->hide();
}

QString StatisticsPanel::text() const {
  QStringList texts;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    texts << names_[i]->text() + ' ' + values_[i]->text();
  }
  return texts.join(", ");
}

namespace {

constexpr double kHandleHeight = 9;
constexpr double kHandleHalfWidth = 6;
constexpr double kHandleReach = 7;     // of the mouse to a handle, logical pixels
constexpr double kLeastShare = 0.005;  // of the axis that a range keeps

}  // namespace

HistogramView::HistogramView(QWidget* parent) : QWidget(parent) {
  setObjectName("histogramView");
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(tr("Visible values. Drag the handles to change the color range."));
}

void HistogramView::setHistogram(const render::Histogram& histogram,
                                 const render::Shading& shading) {
  // While a handle is dragged the axis stays, or the handle would run away from the hand.
  if (grip_ == Grip::None || histogram_.counts.empty()) histogram_ = histogram;
  shading_ = shading;
  update();
}

QRectF HistogramView::area() const {
  return QRectF(rect()).adjusted(kHandleHalfWidth, 1, -kHandleHalfWidth, -kHandleHeight - 2);
}

double HistogramView::xOf(double value) const {
  const double length = histogram_.axis.length();
  if (!(length > 0)) return area().left();
  return area().left() + (value - histogram_.axis.min) / length * area().width();
}

double HistogramView::valueAt(double x) const {
  return histogram_.axis.min +
         (x - area().left()) / std::max(1.0, area().width()) * histogram_.axis.length();
}

void HistogramView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(area(), theme::kCanvas);
  if (histogram_.counts.empty()) {
    painter.setPen(theme::kCanvasMuted);
    painter.drawText(area(), Qt::AlignCenter, tr("No visible values"));
    return;
  }
  paintBars(painter);
  paintHandles(painter);
}

void HistogramView::paintBars(QPainter& painter) const {
  const auto most = *std::max_element(histogram_.counts.begin(), histogram_.counts.end());
  if (most == 0) return;
  const QRectF inside = area();
  const double width = inside.width() / static_cast<double>(histogram_.counts.size());
  QPolygonF outline;  // bars as dark as the ground have nothing else
  for (std::size_t i = 0; i < histogram_.counts.size(); ++i) {
    const double left = inside.left() + static_cast<double>(i) * width;
    if (histogram_.counts[i] == 0) {
      outline << QPointF(left, inside.bottom()) << QPointF(left + width, inside.bottom());
      continue;
    }
    // By the square root: small heaps, which errors are, stay in sight beside a large one.
    const double part = std::sqrt(histogram_.counts[i] / static_cast<double>(most));
    const double height = std::max(1.0, part * (inside.height() - 2));
    const auto [red, green, blue] =
        shading_.map.color(valueAt(left + width / 2), shading_.range.min, shading_.range.max);
    painter.fillRect(QRectF(left, inside.bottom() - height, width + 0.5, height),
                     QColor(red, green, blue));
    const double top = inside.bottom() - height;
    outline << QPointF(left, top) << QPointF(left + width, top);
  }
  painter.setPen(theme::kCanvasMuted);
  painter.drawPolyline(outline);
}

void HistogramView::paintHandles(QPainter& painter) const {
  const QRectF inside = area();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const double value : {shading_.range.min, shading_.range.max}) {
    const double x = std::clamp(xOf(value), inside.left(), inside.right());
    painter.setPen(QPen(QColor(255, 255, 255, 200), 1, Qt::DashLine));
    painter.drawLine(QLineF(x, inside.top(), x, inside.bottom()));
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1));
    painter.setBrush(palette().color(QPalette::Button));
    const double top = inside.bottom() + 1;
    painter.drawPolygon(
        QPolygonF({QPointF(x, top), QPointF(x + kHandleHalfWidth - 1, top + kHandleHeight - 1),
                   QPointF(x - kHandleHalfWidth + 1, top + kHandleHeight - 1)}));
  }
}

HistogramView::Grip HistogramView::gripAt(QPointF position) const {
  if (histogram_.counts.empty()) return Grip::None;
  const double min = std::clamp(xOf(shading_.range.min), area().left(), area().right());
  const double max = std::clamp(xOf(shading_.range.max), area().left(), area().right());
  const double to_min = std::abs(position.x() - min);
  const double to_max = std::abs(position.x() - max);
  if (std::min(to_min, to_max) <= kHandleReach) return to_min < to_max ? Grip::Min : Grip::Max;
  return position.x() > min && position.x() < max ? Grip::Both : Grip::None;
}

void HistogramView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  grip_ = gripAt(event->position());
  pressed_value_ = valueAt(event->position().x());
  pressed_range_ = shading_.range;
}

void HistogramView::mouseMoveEvent(QMouseEvent* event) {
  const Grip hovered = grip_ == Grip::None ? gripAt(event->position()) : grip_;
  setCursor(hovered == Grip::None   ? Qt::ArrowCursor
            : hovered == Grip::Both ? Qt::OpenHandCursor
                                    : Qt::SizeHorCursor);
  if (grip_ == Grip::None) return;
  const double moved = valueAt(event->position().x()) - pressed_value_;
  const double least = kLeastShare * histogram_.axis.length();
  Interval range = pressed_range_;
  if (grip_ != Grip::Max) range.min += moved;
  if (grip_ != Grip::Min) range.max += moved;
  if (grip_ == Grip::Min) range.min = std::min(range.min, range.max - least);
  if (grip_ == Grip::Max) range.max = std::max(range.max, range.min + least);
  shading_.range = range;
  update();
  emit rangeEdited(range);
}

ErrorPlotPanel::ErrorPlotPanel(QWidget* parent)
    : QWidget(parent),
      title_(named("errors.title", new QLabel(this))),
      squares_(named("errors.squares", new LinePlot(this))),
      bad_(named("errors.bad", new LinePlot(this))) {
  setObjectName("errorPlotPanel");
  title_->setWordWrap(true);
  squares_->setAccessibleName(tr("Mean squared error by true disparity"));
  bad_->setAccessibleName(tr("Bad pixels by true disparity"));
  make_column(this, {title_, {squares_, 1}, {bad_, 1}},
              {.margins = {0, theme::kSpacing, 0, 0}, .spacing = theme::kSpacing});
}

void ErrorPlotPanel::setPlots(const QString& title, const Plot& squares, const Plot& bad) {
  title_->setText(title);
  squares_->setPlot(squares);
  bad_->setPlot(bad);
}

void ErrorPlotPanel::clear(const QString& why) {
  title_->clear();
  for (LinePlot* plot : {squares_, bad_}) {
    plot->setPlot({});
    plot->setEmptyText(why);
  }
}

}  // namespace episcope

#include "moc_statistics_panel.cpp"
