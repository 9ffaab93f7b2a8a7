// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/annotate/epi_strip_view.h"

#include "widgets/style/theme.h"

#include <QFontMetrics>
#include <QMouseEvent>
#include <QPainter>

#include <algorithm>

namespace episcope {
namespace {

constexpr int kViewHeight = 7;  // of a row of an EPI
constexpr int kGap = 6;

void draw_edges(QPainter& painter, const PixelEdges& edges, const QRectF& area, const QSize& pixels,
                const QPen& pen) {
  const double across = area.width() / pixels.width();
  const double down = area.height() / pixels.height();
  QList<QLineF> lines;
  for (const QLine& edge : edges) {
    lines << QLineF(area.left() + edge.x1() * across, area.top() + edge.y1() * down,
                    area.left() + edge.x2() * across, area.top() + edge.y2() * down);
  }
  painter.setPen(pen);
  painter.drawLines(lines);
}

}  // namespace

EpiStripView::EpiStripView(QWidget* parent) : QWidget(parent) {
  setObjectName("epiStrip");
  setAccessibleName(tr("EPIs through the label"));
}

void EpiStripView::setEpis(std::vector<Epi> epis, const QColor& color, int current_view) {
  epis_ = std::move(epis);
  color_ = color;
  current_view_ = current_view;
  setMinimumHeight(sizeHint().height());
  updateGeometry();
  update();
}

void EpiStripView::setHint(const QString& hint) {
  hint_ = hint;
  update();
}

QRectF EpiStripView::areaOf(int index) const {
  const int text = fontMetrics().height();
  double y = kGap;
  for (int i = 0; i < index; ++i) {
    y += text + epis_[static_cast<std::size_t>(i)].picture.height() * kViewHeight + kGap;
  }
  const QImage& picture = epis_[static_cast<std::size_t>(index)].picture;
  return {1.0 * kGap, y + text, width() - 2.0 * kGap, 1.0 * picture.height() * kViewHeight};
}

QSize EpiStripView::sizeHint() const {
  const int height = epis_.empty() ? 120 : static_cast<int>(areaOf(count() - 1).bottom()) + kGap;
  return {560, height};
}

void EpiStripView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), theme::kCanvas);
  if (epis_.empty()) {
    painter.setPen(theme::kCanvasText);
    painter.drawText(rect().adjusted(kGap, kGap, -kGap, -kGap), Qt::AlignCenter | Qt::TextWordWrap,
                     hint_);
  }
  for (int i = 0; i < count(); ++i) paintEpi(painter, i);
}

void EpiStripView::paintEpi(QPainter& painter, int index) const {
  const Epi& epi = epis_[static_cast<std::size_t>(index)];
  const QRectF area = areaOf(index);
  painter.setPen(theme::kCanvasMuted);
  painter.drawText(QPointF(area.left(), area.top() - fontMetrics().descent()), epi.caption);
  painter.drawImage(area, epi.picture);
  draw_edges(painter, epi.others, area, epi.picture.size(), QPen(QColor(255, 255, 255, 130), 1));
  draw_edges(painter, epi.boundaries, area, epi.picture.size(),
             QPen(QColor(0, 0, 0, 170), 4, Qt::SolidLine, Qt::FlatCap));
  draw_edges(painter, epi.boundaries, area, epi.picture.size(),
             QPen(color_, 2, Qt::SolidLine, Qt::SquareCap));
  const double y = area.top() + (current_view_ + 0.5) * kViewHeight;
  painter.setPen(QPen(theme::kCrossHair, 1));
  painter.drawLine(QPointF(area.left() - kGap + 1, y), QPointF(area.left() - 1, y));
  painter.drawLine(QPointF(area.right() + 1, y), QPointF(area.right() + kGap - 1, y));
}

void EpiStripView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  for (int i = 0; i < count(); ++i) {
    const QRectF area = areaOf(i);
    if (!area.contains(event->position())) continue;
    const QSize pixels = epis_[static_cast<std::size_t>(i)].picture.size();
    const QPointF at = event->position() - area.topLeft();
    const auto place = static_cast<int>(at.x() / area.width() * pixels.width());
    const auto view = static_cast<int>(at.y() / kViewHeight);
    emit clicked(i, std::min(view, pixels.height() - 1), std::min(place, pixels.width() - 1));
    return;
  }
}

}  // namespace episcope

#include "moc_epi_strip_view.cpp"
