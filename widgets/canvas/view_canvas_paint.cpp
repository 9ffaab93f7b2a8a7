// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/canvas_geometry.h"
#include "widgets/canvas/canvas_tool.h"
#include "widgets/canvas/view_canvas.h"
#include "widgets/controls/text.h"
#include "widgets/controls/theme.h"

#include <QLineF>
#include <QPaintEvent>
#include <QPainter>
#include <QTransform>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

/// Logical pixels per image pixel from which values are printed.
constexpr double kTextScale = 40;

bool is_light(QRgb pixel) {
  return 299 * qRed(pixel) + 587 * qGreen(pixel) + 114 * qBlue(pixel) > 140 * 1000;
}

void draw_haloed_line(QPainter& painter, const QLineF& line, const QColor& color) {
  painter.setPen(QPen(QColor(0, 0, 0, 80), 3));
  painter.drawLine(line);
  painter.setPen(QPen(color, 1));
  painter.drawLine(line);
}

}  // namespace

void ViewCanvas::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.fillRect(event->rect(), theme::kCanvas);
  if (state_ == State::Picture) {
    QRect left = event->rect();
    if (wipe_position_) left.setRight(std::min(left.right(), static_cast<int>(dividerX())));
    if (!left.isEmpty()) paintPicture(painter, left, overlay_);
    if (wipe_position_) paintWipe(painter, event->rect());
    paintEdges(painter, region_, QPen(theme::kCrossHair, 2, Qt::DashLine, Qt::FlatCap));
    paintEdges(painter, outline_, QPen(Qt::white, 2, Qt::SolidLine, Qt::SquareCap));
    paintCrossHair(painter);
    paintMarks(painter);
    if (pixel_text_ && transform_.scale >= kTextScale) paintPixelTexts(painter, event->rect());
    paintShape(painter);
    paintMark(painter);
    paintCaption(painter);
  } else {
    paintMessage(painter);
  }
  if (hasFocus()) {
    painter.setPen(QPen(palette().color(QPalette::Highlight), 1));
    painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

void ViewCanvas::paintPicture(QPainter& painter, const QRect& exposed,
                              const QImage& overlay) const {
  const QRectF seen(transform_.to_image(QRectF(exposed).topLeft(), size()),
                    transform_.to_image(QRectF(exposed).bottomRight(), size()));
  // Whole pixels only, so that samples do not shift with the exposed part.
  const QRectF source = QRectF(seen.toAlignedRect().adjusted(-1, -1, 1, 1) & picture_.rect());
  if (source.isEmpty()) return;
  const QRectF target(transform_.to_widget(source.topLeft(), size()),
                      transform_.to_widget(source.bottomRight(), size()));
  painter.setRenderHint(QPainter::SmoothPixmapTransform,
                        transform_.scale * devicePixelRatioF() < 1);
  painter.drawImage(target, pictureUnder(overlay), source);
  if (!overlay.isNull() && overlay_opacity_ > 0) {
    const double across = 1.0 * overlay.width() / picture_.width();
    const double down = 1.0 * overlay.height() / picture_.height();
    painter.setOpacity(overlay_opacity_);
    painter.drawImage(target, overlay,
                      QRectF(source.x() * across, source.y() * down, source.width() * across,
                             source.height() * down));
    painter.setOpacity(1);
  }
  if (scribbles_.size() == picture_.size() && scribble_opacity_ > 0) {
    painter.setOpacity(scribble_opacity_);
    painter.drawImage(target, scribbles_, source);
    painter.setOpacity(1);
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform, false);
}

void ViewCanvas::paintWipe(QPainter& painter, const QRect& exposed) const {
  const double x = dividerX();
  const QRect right = QRect(static_cast<int>(x), 0, width(), height()) & exposed;
  painter.save();
  painter.setClipRect(right);
  painter.fillRect(right, theme::kCanvas);
  paintPicture(painter, right, wipe_overlay_);
  painter.restore();
  draw_haloed_line(painter, {x, 0.0, x, height() * 1.0}, Qt::white);
  // A grip in the middle: two arrow heads.
  const QPointF middle(x, height() / 2.0);
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(QColor(0, 0, 0, 120), 1));
  painter.setBrush(Qt::white);
  painter.drawRoundedRect(QRectF(middle.x() - 9, middle.y() - 14, 18, 28), 5, 5);
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(0x30, 0x34, 0x38));
  for (const double side : {-1.0, 1.0}) {
    painter.drawPolygon(QPolygonF({middle + QPointF(side * 6, 0), middle + QPointF(side * 2, -5),
                                   middle + QPointF(side * 2, 5)}));
  }
  painter.restore();
}

void ViewCanvas::paintPixelTexts(QPainter& painter, const QRect& exposed) const {
  const QRectF seen(transform_.to_image(QRectF(exposed).topLeft(), size()),
                    transform_.to_image(QRectF(exposed).bottomRight(), size()));
  const QRect pixels = seen.toAlignedRect() & picture_.rect();
  QFont font = painter.font();
  font.setPixelSize(static_cast<int>(std::clamp(transform_.scale / 4.6, 8.0, 13.0)));
  painter.setFont(font);
  for (int y = pixels.top(); y <= pixels.bottom(); ++y) {
    for (int x = pixels.left(); x <= pixels.right(); ++x) {
      // Right of a divider, the values of the other side would have to stand.
      if (wipe_position_ && positionOf({y, x}).x() > dividerX()) continue;
      const QStringList lines = pixel_text_(y, x);
      if (lines.isEmpty()) continue;
      // What is on screen decides between dark and light letters.
      QColor shown = pictureUnder(overlay_).pixelColor(x, y);
      if (overlay_.size() == picture_.size()) {
        const QColor above = overlay_.pixelColor(x, y);
        shown = theme::blend(shown, above, overlay_opacity_ * above.alphaF());
      }
      const QRectF cell(transform_.to_widget(QPointF(x, y), size()),
                        QSizeF(transform_.scale, transform_.scale));
      painter.setPen(is_light(shown.rgb()) ? Qt::black : Qt::white);
      painter.drawText(cell, Qt::AlignCenter, lines.join('\n'));
    }
  }
  painter.setFont(this->font());
}

void ViewCanvas::paintCrossHair(QPainter& painter) const {
  if (!cross_hair_) return;
  const QPointF at = positionOf(*cross_hair_);
  const double gap = std::max(5.0, transform_.scale / 2 + 2);
  // On the middle of device pixels, so that lines of width 1 are crisp.
  const double x = std::floor(at.x()) + 0.5;
  const double y = std::floor(at.y()) + 0.5;
  draw_haloed_line(painter, {0.0, y, x - gap, y}, theme::kCrossHair);
  draw_haloed_line(painter, {x + gap, y, width() * 1.0, y}, theme::kCrossHair);
  draw_haloed_line(painter, {x, 0.0, x, y - gap}, theme::kCrossHair);
  draw_haloed_line(painter, {x, y + gap, x, height() * 1.0}, theme::kCrossHair);
  if (transform_.scale >= 6) {
    const double half = transform_.scale / 2;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(theme::kCrossHair, 1));
    painter.drawRect(QRectF(at.x() - half, at.y() - half, 2 * half, 2 * half));
  }
}

void ViewCanvas::paintEdges(QPainter& painter, const PixelEdges& edges, const QPen& pen) const {
  if (edges.empty()) return;
  QList<QLineF> lines;
  for (const QLine& edge : edges) {
    lines << QLineF(transform_.to_widget(QPointF(edge.p1()), size()),
                    transform_.to_widget(QPointF(edge.p2()), size()));
  }
  painter.setPen(QPen(QColor(0, 0, 0, 200), 4, Qt::SolidLine, Qt::SquareCap));
  painter.drawLines(lines);
  painter.setPen(pen);
  painter.drawLines(lines);
}

void ViewCanvas::paintCaption(QPainter& painter) const {
  QRectF left = rect();
  if (wipe_position_) {
    left.setWidth(width() / 2.0);
    draw_plate(painter, left.translated(left.width(), 0), Qt::AlignRight | Qt::AlignTop,
               wipe_caption_, theme::kCanvasText, Side::B);
  }
  draw_plate(painter, left, Qt::AlignLeft | Qt::AlignTop, caption_, theme::kCanvasText, side_);
  const double percent = 100 * transform_.scale * devicePixelRatioF();
  draw_plate(painter, rect(), Qt::AlignRight | Qt::AlignBottom,
             tr("%1 %").arg(percent, 0, 'f', percent < 10 ? 1 : 0), theme::kCanvasMuted);
}

void ViewCanvas::paintMessage(QPainter& painter) const {
  const QRectF area = QRectF(rect()).adjusted(24, 24, -24, -24);
  QFont title = font();
  title.setPointSizeF(title.pointSizeF() * 1.25);
  QString head;
  QColor head_color = theme::kCanvasText;
  if (state_ == State::Empty) head = tr("No light field");
  if (state_ == State::Loading) head = tr("Loading");
  if (state_ == State::Failed) {
    head = tr("Could not show this");
    head_color = QColor(0xff, 0x9a, 0x8f);
  }
  const double middle = area.center().y();
  painter.setPen(head_color);
  painter.setFont(title);
  painter.drawText(QRectF(area.left(), middle - 44, area.width(), 32),
                   Qt::AlignHCenter | Qt::AlignBottom, head);
  painter.setFont(font());
  painter.setPen(theme::kCanvasMuted);
  painter.drawText(QRectF(area.left(), middle - 4, area.width(), area.bottom() - middle),
                   Qt::AlignHCenter | Qt::AlignTop | Qt::TextWordWrap, breakable(message_));
  if (state_ != State::Loading || loading_fraction_ < 0) return;
  const QRectF bar(area.center().x() - std::min(120.0, area.width() / 2), middle + 28,
                   std::min(240.0, area.width()), 4);
  painter.fillRect(bar, QColor(255, 255, 255, 40));
  painter.fillRect(QRectF(bar.topLeft(), QSizeF(bar.width() * loading_fraction_, bar.height())),
                   theme::kEstimate);
}

namespace {

// Logical pixels.
constexpr double kMarkReach = 8;
constexpr double kRadius = 4;
constexpr double kLargeRadius = 7;

void draw_mark(QPainter& painter, const CanvasMark& mark, QPointF at,
               const std::optional<QPointF>& wanted) {
  const QColor color = mark.is_emphasised ? theme::kCrossHair : theme::kEstimate;
  const double radius = mark.is_emphasised ? kLargeRadius : kRadius;
  const QPointF text = at + QPointF(radius + 3, -radius);
  painter.setBrush(Qt::NoBrush);
  for (const bool is_halo : {true, false}) {
    painter.setPen(QPen(is_halo ? QColor(0, 0, 0, 170) : color, is_halo ? 4 : 2));
    if (wanted) painter.drawLine(at, *wanted);
    painter.drawEllipse(at, radius, radius);
    painter.drawPoint(at);
  }
  painter.setPen(QColor(0, 0, 0, 200));
  for (const QPointF shift : {QPointF(1, 1), QPointF(-1, 1), QPointF(1, -1), QPointF(-1, -1)}) {
    painter.drawText(text + shift, mark.name);
  }
  painter.setPen(color);
  painter.drawText(text, mark.name);
}

}  // namespace

void ViewCanvas::setMarks(std::vector<CanvasMark> marks) {
  if (marks == marks_) return;
  marks_ = std::move(marks);
  update();
}

std::optional<int> ViewCanvas::markAt(QPointF position) const {
  std::optional<int> nearest;
  double least = kMarkReach;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const QPointF at = transform_.to_widget(marks_[i].at, size());
    const double distance = QLineF(at, position).length();
    if (distance > least) continue;
    least = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

// What is emphasized lies over the others.
void ViewCanvas::paintMarks(QPainter& painter) const {
  if (marks_.empty()) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  for (const bool is_emphasised : {false, true}) {
    for (const CanvasMark& mark : marks_) {
      if (mark.is_emphasised != is_emphasised) continue;
      std::optional<QPointF> wanted;
      if (mark.wanted) wanted = transform_.to_widget(*mark.wanted, size());
      draw_mark(painter, mark, transform_.to_widget(mark.at, size()), wanted);
    }
  }
  painter.restore();
}

void ViewCanvas::paintMark(QPainter& painter) const {
  const bool is_in_use = gesture_ == Gesture::None || gesture_ == Gesture::Tool;
  if (tool_ && cursor_ && is_in_use && !space_held_) {
    tool_->paintMark(painter, *cursor_, transform_.scale);
  }
}

void ViewCanvas::paintShape(QPainter& painter) const {
  if (!tool_) return;
  const QPointF origin = transform_.to_widget(QPointF(0, 0), size());
  QTransform widget_from_image = QTransform::fromTranslate(origin.x(), origin.y());
  widget_from_image.scale(transform_.scale, transform_.scale);
  tool_->paintShape(painter, widget_from_image);
}

}  // namespace episcope
