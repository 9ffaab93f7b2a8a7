// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/plot/painter_device.h"

#include <vtkBrush.h>
#include <vtkMatrix3x3.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkStdString.h>
#include <vtkTextProperty.h>
#include <vtkUnicodeString.h>

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

QColor color_of(const vtkColor4ub& color) {
  return {color.GetRed(), color.GetGreen(), color.GetBlue(), color.GetAlpha()};
}

QTransform transform_of(vtkMatrix3x3& matrix) {
  return {matrix.GetElement(0, 0), matrix.GetElement(1, 0), matrix.GetElement(0, 1),
          matrix.GetElement(1, 1), matrix.GetElement(0, 2), matrix.GetElement(1, 2)};
}

Qt::PenStyle style_of(int line_type) {
  switch (line_type) {
    case vtkPen::NO_PEN:
      return Qt::NoPen;
    case vtkPen::DASH_LINE:
      return Qt::DashLine;
    case vtkPen::DOT_LINE:
      return Qt::DotLine;
    case vtkPen::DASH_DOT_LINE:
      return Qt::DashDotLine;
    case vtkPen::DASH_DOT_DOT_LINE:
      return Qt::DashDotDotLine;
    default:
      return Qt::SolidLine;
  }
}

void draw_marker(QPainter& painter, int shape, QPointF at, double half) {
  const QPointF right(half, 0), down(0, half), corner(half, half), other(half, -half);
  switch (shape) {
    case vtkPlotPoints::CROSS:
      painter.drawLine(at - corner, at + corner);
      painter.drawLine(at - other, at + other);
      break;
    case vtkPlotPoints::PLUS:
      painter.drawLine(at - right, at + right);
      painter.drawLine(at - down, at + down);
      break;
    case vtkPlotPoints::SQUARE:
      painter.drawRect(QRectF(at - corner, at + corner));
      break;
    case vtkPlotPoints::DIAMOND:
      painter.drawPolygon(QPolygonF({at - right, at - down, at + right, at + down}));
      break;
    default:
      painter.drawEllipse(at, half, half);
  }
}

}  // namespace

vtkStandardNewMacro(PainterDevice);

void PainterDevice::setPainter(QPainter* painter, int height) {
  painter_ = painter;
  height_ = height;
  matrix_ = {};
  matrices_.clear();
}

QPolygonF PainterDevice::mapped(const float* points, int n) const {
  QPolygonF polygon;
  polygon.reserve(n);
  for (int i = 0; i < n; ++i) {
    const QPointF place = matrix_.map(QPointF(points[2 * i], points[2 * i + 1]));
    polygon << QPointF(place.x(), height_ - place.y());
  }
  return polygon;
}

QPen PainterDevice::pen() const {
  QPen pen(color_of(Pen->GetColorObject()), Pen->GetWidth(), style_of(Pen->GetLineType()));
  pen.setCapStyle(Qt::FlatCap);
  pen.setJoinStyle(Qt::RoundJoin);
  return pen;
}

void PainterDevice::DrawPoly(float* points, int n, unsigned char*, int) {
  painter_->setPen(pen());
  painter_->drawPolyline(mapped(points, n));
}

void PainterDevice::DrawLines(float* points, int n, unsigned char*, int) {
  painter_->setPen(pen());
  const QPolygonF ends = mapped(points, n);
  for (int i = 0; i + 1 < n; i += 2) painter_->drawLine(ends[i], ends[i + 1]);
}

void PainterDevice::DrawPoints(float* points, int n, unsigned char*, int) {
  painter_->setPen(pen());
  painter_->drawPoints(mapped(points, n));
}

void PainterDevice::DrawMarkers(int shape, bool highlight, float* points, int n, unsigned char*,
                                int) {
  if (highlight) return;  // drawn beneath all markers of a line that is selected in VTK
  const QColor color = color_of(Pen->GetColorObject());
  painter_->setPen(QPen(color, 2));
  painter_->setBrush(color);
  for (const QPointF& at : mapped(points, n)) {
    draw_marker(*painter_, shape, at, Pen->GetWidth() / 2.0);
  }
}

void PainterDevice::DrawQuad(float* points, int n) {
  DrawColoredPolygon(points, n, nullptr, 0);
}

void PainterDevice::DrawColoredPolygon(float* points, int n, unsigned char*, int) {
  painter_->setPen(Qt::NoPen);
  painter_->setBrush(color_of(Brush->GetColorObject()));
  painter_->drawPolygon(mapped(points, n));
}

QRectF PainterDevice::textRect(const QString& text) const {
  const QFontMetricsF metrics(painter_->font(), painter_->device());
  QRectF rect(0, 0, metrics.horizontalAdvance(text), metrics.ascent() + metrics.descent());
  const int across = TextProp->GetJustification(), along = TextProp->GetVerticalJustification();
  if (across == VTK_TEXT_CENTERED) rect.moveLeft(-rect.width() / 2);
  if (across == VTK_TEXT_RIGHT) rect.moveLeft(-rect.width());
  if (along == VTK_TEXT_CENTERED) rect.moveTop(-rect.height() / 2);
  if (along == VTK_TEXT_BOTTOM) rect.moveTop(-rect.height());
  return rect;
}

void PainterDevice::DrawString(float* point, const vtkStdString& text) {
  const QString shown = QString::fromStdString(text);
  double color[3];
  TextProp->GetColor(color);
  painter_->save();
  painter_->translate(mapped(point, 1).front());
  painter_->rotate(-TextProp->GetOrientation());
  painter_->setPen(QColor::fromRgbF(static_cast<float>(color[0]), static_cast<float>(color[1]),
                                    static_cast<float>(color[2])));
  painter_->drawText(textRect(shown), Qt::AlignCenter | Qt::TextDontClip, shown);
  painter_->restore();
}

void PainterDevice::ComputeStringBounds(const vtkStdString& text, float bounds[4]) {
  const QRectF turned = QTransform()
                            .rotate(-TextProp->GetOrientation())
                            .mapRect(textRect(QString::fromStdString(text)));
  bounds[0] = static_cast<float>(turned.left());
  bounds[1] = static_cast<float>(-turned.bottom());
  bounds[2] = static_cast<float>(turned.width());
  bounds[3] = static_cast<float>(turned.height());
}

void PainterDevice::ComputeJustifiedStringBounds(const char* text, float bounds[4]) {
  ComputeStringBounds(vtkStdString(text), bounds);
}

void PainterDevice::DrawString(float* point, const vtkUnicodeString& text) {
  DrawString(point, vtkStdString(text.utf8_str()));
}

void PainterDevice::ComputeStringBounds(const vtkUnicodeString& text, float bounds[4]) {
  ComputeStringBounds(vtkStdString(text.utf8_str()), bounds);
}

void PainterDevice::DrawMathTextString(float* point, const vtkStdString& text) {
  DrawString(point, text);
}

void PainterDevice::SetColor4(unsigned char color[4]) {
  Pen->SetColor(color);
  Brush->SetColor(color);
}

void PainterDevice::SetPointSize(float size) {
  Pen->SetWidth(size);
}

void PainterDevice::SetLineWidth(float width) {
  Pen->SetWidth(width);
}

void PainterDevice::SetLineType(int type) {
  Pen->SetLineType(type);
}

void PainterDevice::SetMatrix(vtkMatrix3x3* matrix) {
  matrix_ = transform_of(*matrix);
}

void PainterDevice::GetMatrix(vtkMatrix3x3* matrix) {
  const QTransform& m = matrix_;
  const double elements[] = {m.m11(), m.m21(), m.dx(), m.m12(), m.m22(), m.dy(), 0, 0, 1};
  for (int i = 0; i < 9; ++i) matrix->SetElement(i / 3, i % 3, elements[i]);
}

void PainterDevice::MultiplyMatrix(vtkMatrix3x3* matrix) {
  matrix_ = transform_of(*matrix) * matrix_;
}

void PainterDevice::PushMatrix() {
  matrices_.push_back(matrix_);
}

void PainterDevice::PopMatrix() {
  matrix_ = matrices_.back();
  matrices_.pop_back();
}

void PainterDevice::SetClipping(int* rect) {
  // Half a marker beyond the axes is still to be seen.
  clip_ = QRect(rect[0], height_ - rect[1] - rect[3], rect[2], rect[3]).adjusted(-5, -5, 5, 5);
}

void PainterDevice::EnableClipping(bool enable) {
  painter_->setClipping(enable);
  if (enable) painter_->setClipRect(clip_);
}

}  // namespace episcope
