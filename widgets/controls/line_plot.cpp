// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/line_plot.h"

#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QFontMetricsF>
#include <QKeyEvent>
#include <QLineF>
#include <QMouseEvent>
#include <QPainter>
#include <QPolygonF>
#include <QStringList>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr double kPointReach = 9;  // of the mouse, logical pixels
constexpr double kMarkRadius = 7;
constexpr double kHoverRadius = 5;

constexpr double kLineWidth = 1.6;
constexpr double kMarkerRadius = 3.5;
constexpr double kEdge = 14;          // around the lines, for half of an axis' last number
constexpr double kTextGap = 4;        // between lines of text
constexpr double kSample = 24;        // of a line, in the legend
constexpr double kLegendShare = 0.3;  // of the width, at most, for a name
constexpr double kAxisRoom = 0.05;    // of an axis, beyond the points

bool walks(const QKeyEvent& key) {
  constexpr std::array<int, 6> kKeys{Qt::Key_Left, Qt::Key_Right,  Qt::Key_Up,
                                     Qt::Key_Down, Qt::Key_Return, Qt::Key_Enter};
  return !(key.modifiers() & ~Qt::KeypadModifier) &&
         std::ranges::find(kKeys, key.key()) != kKeys.end();
}

bool is_finite(QPointF point) {
  return std::isfinite(point.x()) && std::isfinite(point.y());
}

}  // namespace

/// An axis of a chart: which values it shows, and where. Logarithmic axes hold decades.
struct ChartAxis {
  QString title;
  bool is_logarithmic = false;
  double min = 0;
  double max = 1;
  double begin = 0;  ///< Of `min`, in pixels.
  double end = 0;    ///< Of `max`.

  [[nodiscard]] double place(double value) const {
    const double at = is_logarithmic ? std::log10(value) : value;
    return begin + (at - min) / (max - min) * (end - begin);
  }
};

namespace {

// With a little room, so that no point lies on the frame.
ChartAxis axis_of(const Plot& plot, const PlotAxis& described,
                  qreal (QPointF::*coordinate)() const) {
  double min = std::numeric_limits<double>::infinity();
  double max = -min;
  for (const PlotSeries& series : plot.series) {
    for (const QPointF& point : series.points) {
      if (!is_finite(point)) continue;
      min = std::min(min, (point.*coordinate)());
      max = std::max(max, (point.*coordinate)());
    }
  }
  if (described.is_logarithmic && min > 0) {
    const double room = kAxisRoom * std::log10(max / min) + std::log10(1.02);
    return {described.title, true, std::log10(min) - room, std::log10(max) + room};
  }
  const double room = max > min ? kAxisRoom * (max - min) : std::max(0.5 * std::abs(max), 0.5);
  const double least = min >= 0 ? std::max(0.0, min - room) : min - room;
  return {described.title, false, least, max + room};
}

// Multiples of 1, 2 or 5 · 10ⁿ between two values, about `most` of them.
std::vector<double> round_values(double min, double max, double most) {
  const double rough = (max - min) / std::max(most, 1.0);
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const int factor : {5, 2, 1}) {
    if (factor * power >= rough) step = factor * power;
  }
  std::vector<double> values;
  for (double i = std::ceil(min / step); i * step <= max; ++i) values.push_back(i * step + 0.0);
  return values;
}

// Values to label: powers of ten on a logarithmic axis, with 2 and 5 between if there is room.
std::vector<double> ticks_of(const ChartAxis& axis, double most) {
  const double span = axis.max - axis.min;
  if (!axis.is_logarithmic) return round_values(axis.min, axis.max, most);
  if (span < 1) return round_values(std::pow(10, axis.min), std::pow(10, axis.max), most);
  const double step = std::max(1.0, std::ceil(span / most));
  std::vector<double> values;
  for (double decade = std::floor(axis.min); decade <= axis.max; decade += step) {
    for (const int factor : {1, 2, 5}) {
      const double at = decade + std::log10(factor);
      const bool is_told = factor == 1 || 3 * span <= most;
      if (is_told && at >= axis.min && at <= axis.max) values.push_back(std::pow(10, at));
    }
  }
  return values;
}

QString tick_text(double value) {
  return with_minus(QString::number(value, 'g', 6));
}

double widest(const QFontMetricsF& metrics, const QStringList& texts) {
  double width = 0;
  for (const QString& text : texts) width = std::max(width, metrics.horizontalAdvance(text));
  return width;
}

void draw_marker(QPainter& painter, const SeriesLook& look, QPointF at) {
  const double half = kMarkerRadius;
  const QPointF right(half, 0), down(0, half), corner(half, half), other(half, -half);
  painter.setPen(QPen(look.color, 2));
  painter.setBrush(look.color);
  switch (look.marker) {
    case PlotMarker::Cross:
      painter.drawLine(at - corner, at + corner);
      painter.drawLine(at - other, at + other);
      break;
    case PlotMarker::Plus:
      painter.drawLine(at - right, at + right);
      painter.drawLine(at - down, at + down);
      break;
    case PlotMarker::Square:
      painter.drawRect(QRectF(at - corner, at + corner));
      break;
    case PlotMarker::Diamond:
      painter.drawPolygon(QPolygonF({at - right, at - down, at + right, at + down}));
      break;
    case PlotMarker::Circle:
      painter.drawEllipse(at, half, half);
      break;
  }
}

void draw_line(QPainter& painter, const SeriesLook& look, const QPolygonF& points) {
  painter.setPen(QPen(look.color, kLineWidth, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
  painter.drawPolyline(points);
  for (const QPointF& at : points) draw_marker(painter, look, at);
}

// The middle of a pixel, where a thin line is not blurred.
QPointF sharp(double x, double y) {
  return {std::floor(x) + 0.5, std::floor(y) + 0.5};
}

}  // namespace

/// Draws a plot: lines with their points, a grid at round numbers, titles, and a legend beside the
/// lines, never over them.
class PlotChart {
 public:
  void set(const Plot& plot, const QPalette& palette);
  /// Draws in the font of the painter.
  void paint(QPainter& painter, QSize size);
  /// Where a point of these values was drawn last.
  [[nodiscard]] QPointF position_of(QPointF value) const;

 private:
  [[nodiscard]] QStringList legend_of(const QFontMetricsF& metrics, double width) const;
  void paint_grid(QPainter& painter) const;
  void paint_titles(QPainter& painter, QSize size) const;
  void paint_legend(QPainter& painter, const QStringList& names, double width) const;

  Plot plot_;
  std::vector<std::size_t> shown_;  // series with a point
  QPalette palette_;
  ChartAxis x_, y_;
  std::vector<double> x_ticks_, y_ticks_;
  QRectF area_;  // of the lines
};

void PlotChart::set(const Plot& plot, const QPalette& palette) {
  plot_ = plot;
  palette_ = palette;
  shown_.clear();
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (std::ranges::any_of(plot.series[i].points, is_finite)) shown_.push_back(i);
  }
  x_ = axis_of(plot, plot.x, &QPointF::x);
  y_ = axis_of(plot, plot.y, &QPointF::y);
}

void PlotChart::paint(QPainter& painter, QSize size) {
  const QFontMetricsF metrics(painter.font(), painter.device());
  const double line = metrics.height();
  const QStringList names = legend_of(metrics, size.width());
  const double legend_width =
      names.isEmpty() ? 0 : kSample + widest(metrics, names) + 3 * kTextGap + kEdge;
  const double bottom = size.height() - 2 * line - 3 * kTextGap;
  y_ticks_ = ticks_of(y_, (bottom - kEdge) / (2 * line));
  QStringList numbers;
  for (const double tick : y_ticks_) numbers << tick_text(tick);
  const double left = line + widest(metrics, numbers) + 3 * kTextGap;
  area_ = QRectF(QPointF(left, kEdge), QPointF(size.width() - legend_width - kEdge, bottom));
  x_ticks_ = ticks_of(x_, area_.width() / (5 * metrics.averageCharWidth() + kEdge));
  x_.begin = area_.left();
  x_.end = area_.right();
  y_.begin = area_.bottom();
  y_.end = area_.top();
  painter.setRenderHint(QPainter::Antialiasing);
  paint_grid(painter);
  paint_titles(painter, size);
  paint_legend(painter, names, legend_width);
  for (const std::size_t series : shown_) {
    QPolygonF points;
    for (const QPointF& point : plot_.series[series].points) {
      if (is_finite(point)) points << position_of(point);
    }
    draw_line(painter, series_look(series, palette_), points);
  }
}

// Names that are too long would take the room of the lines.
QStringList PlotChart::legend_of(const QFontMetricsF& metrics, double width) const {
  QStringList names;
  if (plot_.series.size() < 2) return names;
  for (const std::size_t series : shown_) {
    names << metrics.elidedText(plot_.series[series].name, Qt::ElideMiddle, kLegendShare * width);
  }
  return names;
}

void PlotChart::paint_grid(QPainter& painter) const {
  const QFontMetricsF metrics(painter.font(), painter.device());
  const QColor text = palette_.color(QPalette::Text);
  const QColor grid = theme::blend(palette_.color(QPalette::Base), text, 0.15);
  double free = 0;  // from where there is room for a number
  for (const double tick : x_ticks_) {
    const double x = x_.place(tick);
    painter.setPen(grid);
    painter.drawLine(sharp(x, area_.top()), sharp(x, area_.bottom()));
    QRectF room(0, 0, metrics.horizontalAdvance(tick_text(tick)), metrics.height());
    room.moveCenter({x, 0});
    room.moveTop(area_.bottom() + kTextGap);
    room.moveRight(std::min(room.right(), area_.right() + kEdge - 2));
    if (room.left() < free) continue;
    free = room.right() + kTextGap;
    painter.setPen(text);
    painter.drawText(room, Qt::AlignCenter | Qt::TextDontClip, tick_text(tick));
  }
  for (const double tick : y_ticks_) {
    const double y = y_.place(tick);
    painter.setPen(grid);
    painter.drawLine(sharp(area_.left(), y), sharp(area_.right(), y));
    const QRectF room(0, y - metrics.height() / 2, area_.left() - kTextGap, metrics.height());
    painter.setPen(text);
    painter.drawText(room, Qt::AlignRight | Qt::AlignVCenter | Qt::TextDontClip, tick_text(tick));
  }
  painter.setPen(theme::frame(palette_));
  painter.drawLine(sharp(area_.left(), area_.bottom()), sharp(area_.right(), area_.bottom()));
  painter.drawLine(sharp(area_.left(), area_.top()), sharp(area_.left(), area_.bottom()));
}

// Of a title longer than its axis, the unit at its end.
void PlotChart::paint_titles(QPainter& painter, QSize size) const {
  const QFontMetricsF metrics(painter.font(), painter.device());
  const auto draw = [&](const QRectF& room, const QString& title) {
    const bool fits = metrics.horizontalAdvance(title) <= room.width();
    const auto unit = fits ? 0 : std::max<qsizetype>(title.lastIndexOf('['), 0);
    painter.drawText(room, Qt::AlignCenter | Qt::TextDontClip,
                     metrics.elidedText(title.mid(unit), Qt::ElideMiddle, room.width()));
  };
  painter.setPen(palette_.color(QPalette::Text));
  const double line = metrics.height();
  draw({area_.left(), size.height() - line - kTextGap, area_.width(), line}, x_.title);
  painter.save();
  painter.translate(kTextGap, area_.bottom());
  painter.rotate(-90);
  draw({0, 0, area_.height(), line}, y_.title);
  painter.restore();
}

void PlotChart::paint_legend(QPainter& painter, const QStringList& names, double width) const {
  if (names.isEmpty()) return;
  const double line = QFontMetricsF(painter.font(), painter.device()).height();
  const double count = static_cast<double>(names.size());
  const QRectF box(sharp(area_.right() + kEdge, area_.top()),
                   QSizeF(width - kEdge, count * line + 2 * kTextGap));
  painter.setPen(theme::frame(palette_));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(box);
  for (int i = 0; i < names.size(); ++i) {
    const QRectF row(box.left() + kTextGap, box.top() + kTextGap + i * line, box.width(), line);
    const QPointF begin(row.left(), row.center().y()), half(kSample / 2, 0);
    const SeriesLook look = series_look(shown_[static_cast<std::size_t>(i)], palette_);
    painter.setPen(QPen(look.color, kLineWidth));
    painter.drawLine(begin, begin + 2 * half);
    draw_marker(painter, look, begin + half);
    painter.setPen(palette_.color(QPalette::Text));
    painter.drawText(row.translated(kSample + kTextGap, 0), Qt::AlignLeft | Qt::AlignVCenter,
                     names[i]);
  }
}

QPointF PlotChart::position_of(QPointF value) const {
  return {x_.place(value.x()), y_.place(value.y())};
}

SeriesLook series_look(std::size_t series, const QPalette& palette) {
  constexpr std::array kOnLight = {0x0072b2U, 0xd55e00U, 0x00805cU,
                                   0xb85590U, 0x8f6200U, 0x2f3337U};
  constexpr std::array kOnDark = {0x56b4e9U, 0xe69f00U, 0x2fc79bU, 0xe39ac4U, 0xf0e442U, 0xe6e6e6U};
  constexpr std::array kMarkers = {PlotMarker::Circle, PlotMarker::Square, PlotMarker::Diamond,
                                   PlotMarker::Cross, PlotMarker::Plus};
  const auto& colors = theme::is_dark(palette) ? kOnDark : kOnLight;
  return {QColor(QRgb(colors[series % colors.size()])), kMarkers[series % kMarkers.size()]};
}

LinePlot::LinePlot(QWidget* parent) : QWidget(parent), chart_(std::make_unique<PlotChart>()) {
  setFocusPolicy(Qt::TabFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  theme::follow_palette(this, this, [this] { chart_->set(plot_, palette()); });
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
  return chart_->position_of(valueOf(place));
}

std::optional<PlotPlace> LinePlot::placeAt(QPointF position) const {
  std::optional<PlotPlace> nearest;
  double reach = kPointReach;
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

}  // namespace episcope

#include "moc_line_plot.cpp"
