// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/point_cloud.h"

#include <QOpenGLWidget>
#include <QPointF>
#include <QString>

#include <cstddef>
#include <memory>
#include <optional>

class QMouseEvent;

namespace episcope {

class CloudScene;

enum class CloudPreset { Front, Tilted, Side };

/// A point cloud drawn by VTK: left drag turns, middle drag pans, wheel zooms, a click picks a
/// point. Cannot live on the offscreen platform: use `make_point_cloud_view`.
class PointCloudView : public QOpenGLWidget {
  Q_OBJECT

 public:
  explicit PointCloudView(QWidget* parent = nullptr);
  ~PointCloudView() override;

  /// Keeps the camera unless the view was empty.
  void setCloud(const PointCloud& cloud);
  /// Factor on z, > 0.
  void setZStretch(double factor);

  [[nodiscard]] std::size_t pointCount() const;

 signals:
  /// Place of the point in the cloud.
  void pointPicked(std::size_t point);

 public slots:
  void showPreset(episcope::CloudPreset preset);
  /// The tilted preset, everything in sight.
  void resetCamera();

 protected:
  bool event(QEvent* event) override;
  void initializeGL() override;
  void paintGL() override;

 private:
  void releaseContext();
  bool handleMouse(const QMouseEvent& event);

  std::unique_ptr<CloudScene> scene_;
  std::optional<QPointF> press_;  // of the left button, until it is dragged
};

/// A PointCloudView, or, where there is no display to draw it, a QLabel saying why.
[[nodiscard]] QWidget* make_point_cloud_view(QWidget* parent);

}  // namespace episcope
