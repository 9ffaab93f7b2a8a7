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

/// A widget drawn by OpenGL off screen and painted like any other widget. With QOpenGLWidget, Qt
/// would recreate the native window when it is first shown: the window would vanish for a moment,
/// and a double click would lose its second half.
class OffscreenGl : public QWidget {
  Q_OBJECT

 public:
  explicit OffscreenGl(QWidget* parent = nullptr);
  /// Owners of objects in the context free them before.
  ~OffscreenGl() override;

  /// Draws and returns the picture, in device pixels; null without OpenGL.
  [[nodiscard]] QImage grabFramebuffer();
  /// Null until the first drawing.
  [[nodiscard]] QOpenGLContext* context() const { return context_.get(); }
  /// Does nothing without a context.
  void makeCurrent();
  void doneCurrent();
  /// Target of `paintGL`.
  [[nodiscard]] unsigned int defaultFramebufferObject() const;

 signals:
  void frameDrawn();

 protected:
  /// Called once before the first `paintGL`, with the context current.
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

enum class CloudPreset { Front, Tilted, Side };

/// Point clouds and surfaces drawn by VTK: left drag turns, middle drag pans, the wheel zooms, a
/// click picks a point. Draws few points while the camera moves, if all take too long, and nothing
/// while nothing changes. Does not work on the offscreen platform: use `make_point_cloud_view`.
class PointCloudView : public OffscreenGl {
  Q_OBJECT

 public:
  explicit PointCloudView(QWidget* parent = nullptr);
  ~PointCloudView() override;

  /// Shows parts, which are held, not copied. Keeps the camera if the user turned it.
  void setParts(CloudPartsPtr parts);
  /// Shows one cloud, always with all its points.
  void setCloud(PointCloud cloud);
  void setLook(const CloudLook& look);
  /// Marks the point of this pixel in every part that has one.
  void setMarkedPixel(std::optional<PixelIndex> pixel);
  /// Draws a cross at each place, in the coordinates of the clouds.
  void setMarkedPlaces(const std::vector<std::array<double, 3>>& places);
  void setNamedMarks(const std::vector<CloudMark>& marks);
  /// Shows a color bar; an empty title removes it.
  void setLegend(const QString& title, const render::Shading& shading = {});

  [[nodiscard]] std::size_t pointCount() const;
  [[nodiscard]] const CloudLook& look() const;
  /// Whether the last frame may have had few points.
  [[nodiscard]] bool isMoving() const;

 signals:
  /// The user picked a point: its index in its part, and the part's index.
  void pointPicked(std::size_t point, std::size_t part);

 public slots:
  /// Shows everything from a preset direction, also after a resize until the user turns the camera.
  void showPreset(episcope::CloudPreset preset);
  /// Shows everything from the tilted preset.
  void resetCamera() { showPreset(CloudPreset::Tilted); }

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

/// Creates a PointCloudView, or a QLabel that tells why there is none.
[[nodiscard]] QWidget* make_point_cloud_view(QWidget* parent);

/// Version of the loaded VTK: "9.1.0".
[[nodiscard]] std::string vtk_version();

}  // namespace episcope
