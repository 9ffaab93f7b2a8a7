// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "widgets/cloud/cloud_actor.h"
#include "widgets/cloud/cloud_look.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <QPointF>

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

class QMouseEvent;
class QWheelEvent;
class vtkGenericOpenGLRenderWindow;
class vtkGenericRenderWindowInteractor;
class vtkInteractorStyleTrackballCamera;
class vtkPlane;
class vtkPlaneCollection;
class vtkRenderer;
class vtkStaticPointLocator;

namespace episcope {

class OffscreenGl;

/// The VTK part of a point cloud view: one render window, one renderer and one actor per cloud,
/// never shared. Drawing needs the view's OpenGL context to be current.
class CloudScene {
 public:
  /// `view` must outlive this.
  explicit CloudScene(OffscreenGl& view);
  ~CloudScene();
  CloudScene(const CloudScene&) = delete;
  CloudScene& operator=(const CloudScene&) = delete;

  /// Call for a new context of the view, and before it ends.
  void initialize();
  void finalize();
  /// Adapts to the size of the view.
  void resize();
  void paint();

  void setParts(CloudPartsPtr parts);
  [[nodiscard]] const CloudParts& parts() const { return *parts_; }
  /// Number of points in all parts.
  [[nodiscard]] std::size_t size() const;
  void setLook(const CloudLook& look);
  [[nodiscard]] const CloudLook& look() const { return look_; }
  /// Marks the point of this pixel in every part that has one.
  void setMarkedPixel(std::optional<PixelIndex> pixel);
  /// Sets crosses at other places, and named marks; see CloudMarks.
  void setMarkedPlaces(std::vector<std::array<double, 3>> places);
  void setNamedMarks(std::vector<CloudMark> marks);
  [[nodiscard]] CloudMarks& marks() { return marks_; }
  /// Draws few points while the camera moves.
  void setMoving(bool is_moving) { is_moving_ = is_moving; }
  [[nodiscard]] bool isMoving() const { return is_moving_; }
  /// Looks from an azimuth and elevation in degrees, beginning with the next frame, when the
  /// window's size is known.
  void lookFrom(double azimuth, double elevation) { wanted_direction_ = {azimuth, elevation}; }

  void handle(const QMouseEvent& event, unsigned long vtk_event);
  void handle(const QWheelEvent& event);
  /// Visible point at a place of the widget, or nearest to it within a few pixels.
  [[nodiscard]] std::optional<PickedPoint> pick(QPointF at);

 private:
  using Box = std::array<double, 6>;  // x0, x1, y0, y1, z0, z1
  using Place = std::array<double, 3>;

  template <class Subject>
  void observe(const Subject& subject, unsigned long event, void (CloudScene::*handler)(void*));
  [[nodiscard]] bool isCurrent() const;
  void makeCurrent(void*);
  void tellCurrent(void* data) { *static_cast<bool*>(data) = isCurrent(); }
  void tellSupported(void* data) { *static_cast<int*>(data) = 1; }
  void askForFrame(void*);
  void render();
  void applyDirection();
  void applyLook();
  void fillWindow(const Box& box);
  [[nodiscard]] Box stretched(Box box) const;
  [[nodiscard]] Place stretched(const Place& place) const;
  [[nodiscard]] Place middle() const;
  void placeMark();
  [[nodiscard]] std::optional<Place> seenAt(int x, int y);
  [[nodiscard]] vtkStaticPointLocator& locator(std::size_t part);

  OffscreenGl& view_;
  CloudPartsPtr parts_;
  CloudLook look_;
  Box box_{};  // around the clouds, before the z-stretch
  std::optional<PixelIndex> marked_;
  std::vector<Place> marked_places_;
  std::vector<CloudMark> named_;
  bool is_moving_ = false;
  std::optional<std::pair<double, double>> wanted_direction_;
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkGenericRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleTrackballCamera> style_;
  vtkNew<vtkPlane> near_;
  vtkNew<vtkPlane> far_;
  vtkNew<vtkPlaneCollection> clip_;
  std::vector<std::unique_ptr<CloudActor>> actors_;
  std::vector<vtkSmartPointer<vtkStaticPointLocator>> locators_;  // of parts; null until needed
  CloudMarks marks_;
};

}  // namespace episcope
