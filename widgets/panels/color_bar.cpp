// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/panels/color_bar.h"

#include "widgets/controls/layout.h"
#include "widgets/controls/number_spin.h"
#include "widgets/controls/theme.h"
#include "widgets/controls/tool_button.h"

#include <QGridLayout>
#include <QImage>
#include <QLabel>
#include <QPainter>
#include <QSignalBlocker>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

NumberSpin* make_end(const char* name, const QString& tip, QWidget* parent) {
  auto* spin = named(name, new NumberSpin(parent));
  spin->setRange(-1e4, 1e4);
  spin->setDecimals(3);
  spin->setButtonSymbols(QAbstractSpinBox::NoButtons);
  spin->setMinimumWidth(46);
  spin->setMaximumWidth(72);
  spin->setToolTip(tip);
  return spin;
}

QString swatch_text(const Rgb& color, const QString& text) {
  return QString("<span style='background:%1'>&nbsp;&nbsp;&nbsp;</span>&nbsp;%2")
      .arg(QColor(color[0], color[1], color[2]).name(), text.toHtmlEscaped());
}

}  // namespace

ColorBar::ColorBar(QWidget* parent)
    : QWidget(parent),
      title_(named("colorBar.title", new QLabel(this))),
      ramp_(new ColorRamp(this)),
      min_(make_end("colorBar.min", tr("Lower end of the range"), this)),
      max_(make_end("colorBar.max", tr("Upper end of the range"), this)),
      swatches_(named("colorBar.swatches", new QLabel(this))),
      invalid_(named("colorBar.invalid", new QLabel(this))),
      lock_(make_tool_button(
          {"colorBar.lock", "unlock", tr("Lock the range: it stays when the result changes")},
          this)),
      automatic_(make_tool_button(
          {"colorBar.automatic", "auto", tr("Automatic range of the visible values")}, this)),
      own_(make_tool_button({"colorBar.own", "reset", tr("Default range of the quantity")}, this)) {
  setObjectName("colorBar");
  title_->setTextInteractionFlags(Qt::NoTextInteraction);
  title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  swatches_->setTextFormat(Qt::RichText);
  swatches_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  swatches_->hide();
  invalid_->setTextFormat(Qt::RichText);
  invalid_->setToolTip(tr("Color of pixels without a value"));
  lock_->setCheckable(true);

  auto* foot = make_row({{invalid_, 1}, lock_, automatic_, own_}, {.spacing = 0});
  auto* ends = make_row({min_, kRoom, max_}, {.spacing = theme::kSpacing});
  auto* layout = make_grid(this, -1, 3);
  layout->addWidget(title_, 0, 0);
  layout->addWidget(ramp_, 1, 0);
  layout->addWidget(swatches_, 1, 0);
  layout->addLayout(ends, 2, 0);
  layout->addLayout(foot, 3, 0);

  connect(min_, &NumberSpin::valueChanged, this, &ColorBar::editRange);
  connect(max_, &NumberSpin::valueChanged, this, &ColorBar::editRange);
  connect(lock_, &QToolButton::toggled, this, &ColorBar::setRangeLocked);
  connect(automatic_, &QToolButton::clicked, this, &ColorBar::automaticRangeRequested);
  connect(own_, &QToolButton::clicked, this, &ColorBar::ownRangeRequested);
}

void ColorBar::setShading(const QString& title, const QString& unit,
                          const render::Shading& shading) {
  const QSignalBlocker min_blocker(min_);
  const QSignalBlocker max_blocker(max_);
  setTitle(unit.isEmpty() ? title : tr("%1 [%2]").arg(title, unit));
  setRampShown(true);
  // Three digits that say something, whatever the range.
  const double reach = std::max(std::abs(shading.range.min), std::abs(shading.range.max));
  const int decimals =
      reach > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(reach))), 0, 5) : 2;
  for (auto* end : {min_, max_}) {
    end->setDecimals(decimals);
    end->setSingleStep(std::max(shading.range.length() / 20, std::pow(10.0, -decimals)));
  }
  min_->setValue(shading.range.min);
  max_->setValue(shading.range.max);
  ramp_->setShading(shading);
  invalid_->setText(swatch_text(shading.map.invalid, tr("invalid")));
}

void ColorBar::setSwatches(const QString& title, const std::vector<Swatch>& swatches,
                           const Rgb& invalid) {
  setTitle(title);
  setRampShown(false);
  QStringList lines;
  for (const Swatch& each : swatches) lines << swatch_text(each.color, each.text);
  swatches_->setText(lines.join("<br>"));
  invalid_->setText(swatch_text(invalid, tr("invalid")));
}

void ColorBar::setTitle(const QString& title) {
  title_->setText(title);
  title_->setToolTip(title);
}

void ColorBar::setRampShown(bool is_shown) {
  for (QWidget* each :
       std::initializer_list<QWidget*>{ramp_, min_, max_, lock_, automatic_, own_}) {
    each->setVisible(is_shown);
  }
  swatches_->setVisible(!is_shown);
}

void ColorBar::setMarker(double value) {
  ramp_->setMarker(value);
}

void ColorBar::setRangeLocked(bool locked) {
  Quietly(lock_)->setChecked(locked);
  lock_->setIcon(themed_icon(locked ? "lock" : "unlock"));
}

void ColorBar::followTips(const QAction* automatic, const QAction* own) {
  follow_tip(automatic_, automatic);
  follow_tip(own_, own);
}

Interval ColorBar::range() const {
  return ramp_->shading().range;
}
void ColorBar::editRange() {
  Interval range{min_->value(), max_->value()};
  // An end pushed past the other one takes it along.
  const double least = std::pow(10.0, -min_->decimals());
  if (range.length() < least) {
    const bool moved_min = sender() == min_;
    (moved_min ? range.max : range.min) = moved_min ? range.min + least : range.max - least;
  }
  Quietly(min_)->setValue(range.min);
  Quietly(max_)->setValue(range.max);
  render::Shading shading = ramp_->shading();
  shading.range = range;
  ramp_->setShading(shading);
  emit rangeEdited(range);
}

ColorRamp::ColorRamp(QWidget* parent)
    : QWidget(parent), marker_(std::numeric_limits<double>::quiet_NaN()) {
  setObjectName("colorBar.ramp");
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void ColorRamp::setShading(const render::Shading& shading) {
  shading_ = shading;
  update();
}

void ColorRamp::setMarker(double value) {
  marker_ = value;
  update();
}

void ColorRamp::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  QImage ramp(static_cast<int>(shading_.map.colors.size()), 1, QImage::Format_RGB32);
  for (int i = 0; i < ramp.width(); ++i) {
    const auto [red, green, blue] = shading_.map.colors[static_cast<std::size_t>(i)];
    ramp.setPixel(i, 0, qRgb(red, green, blue));
  }
  const QRectF area = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
  painter.drawImage(area, ramp);
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(area);
  if (!std::isfinite(marker_) || shading_.range.length() <= 0) return;
  const double part =
      std::clamp((marker_ - shading_.range.min) / shading_.range.length(), 0.0, 1.0);
  const double x = area.left() + part * area.width();
  painter.setPen(QPen(Qt::black, 3));
  painter.drawLine(QLineF(x, area.top(), x, area.bottom()));
  painter.setPen(QPen(Qt::white, 1));
  painter.drawLine(QLineF(x, area.top(), x, area.bottom()));
}

}  // namespace episcope

#include "moc_color_bar.cpp"
