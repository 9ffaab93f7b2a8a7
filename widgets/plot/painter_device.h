// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vtkContextDevice2D.h>

#include <QPen>
#include <QPointF>
#include <QPolygonF>
#include <QTransform>

#include <vector>

class QPainter;

namespace episcope {

/// Where charts of VTK draw: a QPainter. Scene coordinates are logical pixels with y upwards. Text
/// has the font of the painter; lines keep their width whatever the matrix. It draws what charts of
/// lines consist of: lines, polygons, markers and text; images, ellipses and textures are left out.
class PainterDevice : public vtkContextDevice2D {
 public:
  static PainterDevice* New();
  vtkTypeMacro(PainterDevice, vtkContextDevice2D);

  /// Draws with `painter` on `height` logical pixels until the next call; null ends that.
  void setPainter(QPainter* painter, int height);

  void DrawPoly(float* points, int n, unsigned char* colors, int components) override;
  void DrawLines(float* points, int n, unsigned char* colors, int components) override;
  void DrawPoints(float* points, int n, unsigned char* colors, int components) override;
  void DrawMarkers(int shape, bool highlight, float* points, int n, unsigned char* colors,
                   int components) override;
  void DrawQuad(float* points, int n) override;
  void DrawColoredPolygon(float* points, int n, unsigned char* colors, int components) override;
  void DrawString(float* point, const vtkStdString& text) override;
  void ComputeStringBounds(const vtkStdString& text, float bounds[4]) override;
  void ComputeJustifiedStringBounds(const char* text, float bounds[4]) override;
  void DrawString(float* point, const vtkUnicodeString& text) override;
  void ComputeStringBounds(const vtkUnicodeString& text, float bounds[4]) override;
  void DrawMathTextString(float* point, const vtkStdString& text) override;
  void SetColor4(unsigned char color[4]) override;
  void SetPointSize(float size) override;
  void SetLineWidth(float width) override;
  void SetLineType(int type) override;
  void SetMatrix(vtkMatrix3x3* matrix) override;
  void GetMatrix(vtkMatrix3x3* matrix) override;
  void MultiplyMatrix(vtkMatrix3x3* matrix) override;
  void PushMatrix() override;
  void PopMatrix() override;
  void SetClipping(int* rect) override;
  void EnableClipping(bool enable) override;

  void DrawPointSprites(vtkImageData*, float*, int, unsigned char*, int) override {}
  void DrawEllipseWedge(float, float, float, float, float, float, float, float) override {}
  void DrawEllipticArc(float, float, float, float, float, float) override {}
  void DrawImage(float*, float, vtkImageData*) override {}
  void DrawImage(const vtkRectf&, vtkImageData*) override {}
  void SetTexture(vtkImageData*, int) override {}

 protected:
  PainterDevice() = default;

 private:
  [[nodiscard]] QPolygonF mapped(const float* points, int n) const;
  [[nodiscard]] QPen pen() const;
  /// Where text lies around its point, before it is turned; y downwards.
  [[nodiscard]] QRectF textRect(const QString& text) const;

  QPainter* painter_ = nullptr;
  int height_ = 0;
  QTransform matrix_;
  std::vector<QTransform> matrices_;
  QRect clip_;
};

}  // namespace episcope
