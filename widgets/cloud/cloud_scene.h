// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/point_cloud.h"

#include <vtkNew.h>

#include <QPointF>

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

class QMouseEvent;
class QOpenGLWidget;
class QWheelEvent;
class vtkActor;
class vtkGenericOpenGLRenderWindow;
class vtkGenericRenderWindowInteractor;
class vtkInteractorStyleTrackballCamera;
class vtkPointPicker;
class vtkPolyData;
class vtkPolyDataMapper;
class vtkRenderer;

namespace episcope {

/// Everything of VTK in a point cloud view: one render window, one renderer, one actor, never
/// shared. Drawing needs the OpenGL context of the view to be current.
class CloudScene {
 public:
  /// `view` must outlive this.
  explicit CloudScene(QOpenGLWidget& view);
  ~CloudScene();
  CloudScene(const CloudScene&) = delete;
  CloudScene& operator=(const CloudScene&) = delete;

  /// For a new context of the view, and before it ends.
  void initialize();
  void finalize();
  /// Follows the size of the view.
  void resize();
  void paint();

  void setCloud(const PointCloud& cloud);
  void setZStretch(double factor);
  [[nodiscard]] std::size_t size() const;
  /// From an azimuth and elevation in degrees. Takes effect with the next frame, when the size of
  /// the window is known.
  void look(double azimuth, double elevation) { wanted_look_ = {azimuth, elevation}; }

  void handle(const QMouseEvent& event, unsigned long vtk_event);
  void handle(const QWheelEvent& event);
  /// The nearest point under a place of the widget, if there is one.
  [[nodiscard]] std::optional<std::size_t> pick(QPointF at);

 private:
  using Box = std::array<double, 6>;  // x0, x1, y0, y1, z0, z1

  template <class Subject>
  void observe(const Subject& subject, unsigned long event, void (CloudScene::*handler)(void*));
  [[nodiscard]] bool isCurrent() const;
  void makeCurrent(void*);
  void tellCurrent(void* data);
  void tellSupported(void* data);
  void askForFrame(void*);
  void applyLook();
  void fillWindow(const Box& box);

  QOpenGLWidget& view_;
  Box box_{};  // around the cloud, before the z-stretch
  std::optional<std::pair<double, double>> wanted_look_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkGenericRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleTrackballCamera> style_;
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkPointPicker> picker_;
};

}  // namespace episcope
