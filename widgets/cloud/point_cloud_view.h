// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/shade.h"
#include "widgets/cloud/cloud_look.h"

#include <QImage>
#include <QOffscreenSurface>
#include <QPointF>
#include <QString>
#include <QTimer>
#include <QWidget>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

class QMouseEvent;
class QOpenGLContext;
class QOpenGLFramebufferObject;

namespace episcope {

class CloudScene;

/// A widget whose picture OpenGL draws off screen, and that is painted like any other.
/// QOpenGLWidget would have Qt make the native window anew when it is first shown: the window
/// vanishes for a moment, and a double click loses its second half.
class OffscreenGl : public QWidget {
  Q_OBJECT

 public:
  explicit OffscreenGl(QWidget* parent = nullptr);
  /// Whoever has objects in the context frees them before.
  ~OffscreenGl() override;

  /// Draws and returns the picture, in device pixels; null where OpenGL is not to be had.
  [[nodiscard]] QImage grabFramebuffer();
  /// Null until something was drawn.
  [[nodiscard]] QOpenGLContext* context() const { return context_.get(); }
  /// Nothing, as long as there is no context.
  void makeCurrent();
  void doneCurrent();
  /// What `paintGL` draws into.
  [[nodiscard]] unsigned int defaultFramebufferObject() const;

 signals:
  void frameDrawn();

 protected:
  /// Once, with the context current, before the first `paintGL`.
  virtual void initializeGL() = 0;
  /// Draws an opaque picture.
  virtual void paintGL() = 0;
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] bool prepare();
  [[nodiscard]] bool makeContext();

  QOffscreenSurface surface_;
  std::unique_ptr<QOpenGLContext> context_;
  std::unique_ptr<QOpenGLFramebufferObject> frame_;
  bool is_unavailable_ = false;
};

/// Why nothing is drawn where there is no OpenGL.
[[nodiscard]] QString no_gl_text();

enum class CloudPreset { Front, Tilted, Side };

/// Point clouds and surfaces drawn by VTK: left drag turns, middle drag pans, wheel zooms, a click
/// picks a point. While the camera moves, few points are drawn if all take too long. Nothing is
/// drawn while nothing changes. Cannot live on the offscreen platform: use `make_point_cloud_view`.
class PointCloudView : public OffscreenGl {
  Q_OBJECT

 public:
  explicit PointCloudView(QWidget* parent = nullptr);
  ~PointCloudView() override;

  /// Keeps the camera if the user turned it. The parts are held, not copied.
  void setParts(CloudPartsPtr parts);
  /// One cloud, always with all its points.
  void setCloud(PointCloud cloud);
  void setLook(const CloudLook& look);
  /// The point of this pixel is marked in every part that has one.
  void setMarkedPixel(std::optional<PixelIndex> pixel);
  /// A cross at each of these places, in the coordinates of the clouds.
  void setMarkedPlaces(const std::vector<std::array<double, 3>>& places);
  void setNamedMarks(const std::vector<CloudMark>& marks);
  /// A colour bar over the scene; an empty title takes it away.
  void setLegend(const QString& title, const render::Shading& shading = {});

  [[nodiscard]] std::size_t pointCount() const;
  [[nodiscard]] const CloudLook& look() const;
  /// Whether the last frame may have been one of few points.
  [[nodiscard]] bool isMoving() const;

 signals:
  /// Place of the point in its part, and which one that is.
  void pointPicked(std::size_t point, std::size_t part);

 public slots:
  /// Everything in sight, also after a change of size until the user turns it.
  void showPreset(episcope::CloudPreset preset);
  /// The tilted preset, everything in sight.
  void resetCamera();

 protected:
  bool event(QEvent* event) override;
  void initializeGL() override;
  void paintGL() override;

 private:
  void beginMoving();
  bool handleMouse(const QMouseEvent& event);

  std::unique_ptr<CloudScene> scene_;
  std::optional<QPointF> press_;  // of the left button, until it is dragged
  CloudPreset preset_ = CloudPreset::Tilted;
  bool is_turned_ = false;    // since the preset
  QTimer still_;              // ends when nothing has moved for a while
  qint64 full_frame_ms_ = 0;  // that the last frame of all points took
};

/// A PointCloudView, or, where there is no display to draw it, a QLabel saying why.
[[nodiscard]] QWidget* make_point_cloud_view(QWidget* parent);

/// Of the VTK that is loaded: "9.1.0".
[[nodiscard]] std::string vtk_version();

}  // namespace episcope
