// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/plot/line_plot.h"

#include "widgets/plot/plot_chart.h"
#include "widgets/style/theme.h"

#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr double kReach = 9;  // of the mouse, logical pixels
constexpr double kMarkRadius = 7;
constexpr double kHoverRadius = 5;

bool walks(const QKeyEvent& key) {
  if (key.modifiers() & ~Qt::KeypadModifier) return false;
  switch (key.key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
    case Qt::Key_Up:
    case Qt::Key_Down:
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return true;
    default:
      return false;
  }
}

}  // namespace

LinePlot::LinePlot(QWidget* parent) : QWidget(parent), chart_(std::make_unique<PlotChart>()) {
  setFocusPolicy(Qt::TabFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

LinePlot::~LinePlot() = default;

void LinePlot::setPlot(const Plot& plot) {
  plot_ = plot;
  walked_.reset();
  hovered_.reset();
  if (mark_ && !std::isfinite(valueOf(*mark_).y())) mark_.reset();
  chart_->set(plot_, palette());
  update();
}

void LinePlot::setEmptyText(const QString& text) {
  empty_text_ = text;
  update();
}

void LinePlot::setMark(std::optional<PlotPlace> place) {
  mark_ = place;
  walked_.reset();
  update();
}

QPointF LinePlot::valueOf(PlotPlace place) const {
  if (place.series < plot_.series.size() &&
      place.point < plot_.series[place.series].points.size()) {
    return plot_.series[place.series].points[place.point];
  }
  return {qQNaN(), qQNaN()};
}

QPointF LinePlot::positionOf(PlotPlace place) const {
  return chart_->positionOf(valueOf(place));
}

std::optional<PlotPlace> LinePlot::placeAt(QPointF position) const {
  std::optional<PlotPlace> nearest;
  double reach = kReach;
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    for (std::size_t point = 0; point < plot_.series[series].points.size(); ++point) {
      const double distance = QLineF(position, positionOf({series, point})).length();
      if (!(distance <= reach)) continue;
      reach = distance;
      nearest = PlotPlace{series, point};
    }
  }
  return nearest;
}

std::optional<PlotPlace> LinePlot::firstPoint() const {
  for (std::size_t series = 0; series < plot_.series.size(); ++series) {
    for (std::size_t point = 0; point < plot_.series[series].points.size(); ++point) {
      if (std::isfinite(valueOf({series, point}).y())) return PlotPlace{series, point};
    }
  }
  return std::nullopt;
}

QSize LinePlot::sizeHint() const {
  return {320, 190};
}
QSize LinePlot::minimumSizeHint() const {
  return {200, 80};
}

void LinePlot::paintMark(QPainter& painter, PlotPlace place, double radius) const {
  const QPointF at = positionOf(place);
  if (!std::isfinite(at.x()) || !std::isfinite(at.y())) return;
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(palette().color(QPalette::Text), 2));
  painter.drawEllipse(at, radius, radius);
}

void LinePlot::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  painter.setPen(theme::frame(palette()));
  painter.drawRect(rect().adjusted(0, 0, -1, -1));
  if (!firstPoint()) {
    painter.setPen(theme::muted_text(palette()));
    const int margin = theme::kMargin;
    painter.drawText(rect().adjusted(margin, margin, -margin, -margin),
                     Qt::AlignCenter | Qt::TextWordWrap, empty_text_);
    return;
  }
  chart_->paint(painter, size());
  if (mark_) paintMark(painter, *mark_, kMarkRadius);
  if (hovered_) paintMark(painter, *hovered_, kHoverRadius);
  if (walked_ && hasFocus()) paintMark(painter, *walked_, kHoverRadius);
}

void LinePlot::setHovered(std::optional<PlotPlace> place) {
  if (hovered_ == place) return;
  hovered_ = place;
  setCursor(place ? Qt::PointingHandCursor : Qt::ArrowCursor);
  update();
}

void LinePlot::mouseMoveEvent(QMouseEvent* event) {
  setHovered(placeAt(event->position()));
}

void LinePlot::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  if (const auto place = placeAt(event->position())) emit pointChosen(*place);
}

void LinePlot::leaveEvent(QEvent*) {
  setHovered(std::nullopt);
}

bool LinePlot::event(QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride && walks(static_cast<QKeyEvent&>(*event))) {
    event->accept();
    return true;
  }
  return QWidget::event(event);
}

void LinePlot::focusInEvent(QFocusEvent* event) {
  walked_ = mark_ ? mark_ : firstPoint();
  QWidget::focusInEvent(event);
}

void LinePlot::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Left:
      return walk(-1, 0);
    case Qt::Key_Right:
      return walk(1, 0);
    case Qt::Key_Up:
      return walk(0, -1);
    case Qt::Key_Down:
      return walk(0, 1);
    case Qt::Key_Return:
    case Qt::Key_Enter:
      if (walked_) emit pointChosen(*walked_);
      return;
    default:
      QWidget::keyPressEvent(event);
  }
}

void LinePlot::walk(int points, int series) {
  if (!walked_) walked_ = mark_ ? mark_ : firstPoint();
  if (!walked_) return;
  const auto moved = [](std::size_t place, int step, std::size_t count) {
    return static_cast<std::size_t>(
        std::clamp<int>(static_cast<int>(place) + step, 0, static_cast<int>(count) - 1));
  };
  walked_->series = moved(walked_->series, series, plot_.series.size());
  walked_->point = moved(walked_->point, points, plot_.series[walked_->series].points.size());
  update();
}

void LinePlot::changeEvent(QEvent* event) {
  QWidget::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) chart_->set(plot_, palette());
}

}  // namespace episcope

#include "moc_line_plot.cpp"
