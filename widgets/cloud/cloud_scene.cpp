// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_scene.h"

#include "widgets/style/theme.h"

#include <vtkActor.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMath.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPointPicker.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLWidget>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr double kPickReach = 5;  // logical pixels

vtkNew<vtkCellArray> all_points(vtkIdType count) {
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(i);
  return cells;
}

vtkNew<vtkCellArray> cells_of(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  vtkNew<vtkCellArray> cells;
  const auto count = static_cast<vtkIdType>(triangles.size());
  cells->AllocateExact(count, 3 * count);
  for (const auto& [a, b, c] : triangles) {
    cells->InsertNextCell(
        {static_cast<vtkIdType>(a), static_cast<vtkIdType>(b), static_cast<vtkIdType>(c)});
  }
  return cells;
}

}  // namespace

template <class Subject>
void CloudScene::observe(const Subject& subject, unsigned long event,
                         void (CloudScene::*handler)(void*)) {
  struct Link {
    CloudScene* scene;
    void (CloudScene::*handler)(void*);
  };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Link{this, handler});
  command->SetClientDataDeleteCallback([](void* link) { delete static_cast<Link*>(link); });
  command->SetCallback([](vtkObject*, unsigned long, void* link, void* data) {
    const auto* to = static_cast<Link*>(link);
    (to->scene->*to->handler)(data);
  });
  subject->AddObserver(event, command);
}

CloudScene::CloudScene(QOpenGLWidget& view) : view_(view) {
  window_->SetMultiSamples(0);  // With a software renderer, this is most of the time of a frame.
  window_->SetOwnContext(0);
  window_->SetFrameBlitModeToNoBlit();
  window_->AddRenderer(renderer_);
  const QColor background = theme::kCanvas;
  renderer_->SetBackground(background.redF(), background.greenF(), background.blueF());
  mapper_->SetInputData(points_);
  mapper_->SetScalarModeToUsePointData();
  mapper_->SetColorModeToDirectScalars();
  actor_->SetMapper(mapper_);
  actor_->GetProperty()->SetPointSize(2);
  actor_->GetProperty()->LightingOff();
  renderer_->AddActor(actor_);
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style_);
  interactor_->EnableRenderOff();
  observe(window_, vtkCommand::WindowMakeCurrentEvent, &CloudScene::makeCurrent);
  observe(window_, vtkCommand::WindowIsCurrentEvent, &CloudScene::tellCurrent);
  observe(window_, vtkCommand::WindowSupportsOpenGLEvent, &CloudScene::tellSupported);
  observe(interactor_, vtkCommand::RenderEvent, &CloudScene::askForFrame);
  interactor_->Initialize();
}

CloudScene::~CloudScene() = default;

void CloudScene::initialize() {
  window_->SetReadyForRendering(true);
  window_->SetMapped(1);
  window_->SetIsDirect(1);
  window_->SetForceMaximumHardwareLineWidth(1);
  window_->OpenGLInit();
  window_->SetReadyForRendering(false);
  resize();
}

void CloudScene::finalize() {
  window_->SetReadyForRendering(true);
  window_->Finalize();
  window_->SetReadyForRendering(false);
}

void CloudScene::resize() {
  const double ratio = view_.devicePixelRatioF();
  const int width = static_cast<int>(std::lround(view_.width() * ratio));
  const int height = static_cast<int>(std::lround(view_.height() * ratio));
  window_->SetDPI(static_cast<int>(std::lround(96 * ratio)));
  interactor_->UpdateSize(width, height);
  window_->SetSize(width, height);
  actor_->GetProperty()->SetPointSize(static_cast<float>(2 * ratio));
}

void CloudScene::paint() {
  if (wanted_look_) applyLook();
  auto* state = window_->GetState();
  state->Reset();
  state->Push();
  state->vtkglDepthFunc(GL_LEQUAL);  // Qt leaves GL_LESS.
  window_->SetReadyForRendering(true);
  window_->Render();
  window_->SetReadyForRendering(false);
  state->vtkglBindFramebuffer(GL_DRAW_FRAMEBUFFER, view_.defaultFramebufferObject());
  state->vtkglDisable(GL_SCISSOR_TEST);
  window_->BlitDisplayFramebuffer();
  state->Pop();
}

bool CloudScene::isCurrent() const {
  return view_.context() != nullptr && QOpenGLContext::currentContext() == view_.context();
}

// Only if needed: doing it again would bind Qt's framebuffer in the middle of a frame.
void CloudScene::makeCurrent(void*) {
  if (!isCurrent()) view_.makeCurrent();
}

void CloudScene::tellCurrent(void* data) {
  *static_cast<bool*>(data) = isCurrent();
}

void CloudScene::tellSupported(void* data) {
  *static_cast<int*>(data) = 1;
}

void CloudScene::askForFrame(void*) {
  view_.update();
}

void CloudScene::setZStretch(double factor) {
  actor_->SetScale(1, 1, factor);
  renderer_->ResetCameraClippingRange();
}

std::size_t CloudScene::size() const {
  return static_cast<std::size_t>(points_->GetNumberOfPoints());
}

void CloudScene::setCloud(const PointCloud& cloud) {
  const auto count = static_cast<vtkIdType>(cloud.positions.size());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  if (count > 0) {
    std::copy_n(cloud.positions.front().data(), 3 * count, coordinates->GetPointer(0));
    std::copy_n(cloud.colors.front().data(), 3 * count, colors->GetPointer(0));
  }
  vtkNew<vtkPoints> positions;
  positions->SetData(coordinates);
  points_->Initialize();
  points_->SetPoints(positions);
  if (cloud.triangles.empty()) {
    points_->SetVerts(all_points(count));
  } else {
    points_->SetPolys(cells_of(cloud.triangles));
  }
  points_->GetPointData()->SetScalars(colors);
  points_->Modified();
  box_ = robust_bounds(cloud);
  // The z-stretch keeps the middle of the cloud where it is.
  actor_->SetOrigin((box_[0] + box_[1]) / 2, (box_[2] + box_[3]) / 2, (box_[4] + box_[5]) / 2);
  renderer_->ResetCameraClippingRange();
}

void CloudScene::applyLook() {
  const auto [azimuth, elevation] = *std::exchange(wanted_look_, std::nullopt);
  auto* camera = renderer_->GetActiveCamera();
  camera->SetViewAngle(30);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(0, 0, 1);
  camera->SetViewUp(0, 1, 0);
  camera->Azimuth(azimuth);
  camera->Elevation(elevation);
  camera->OrthogonalizeViewUp();
  auto box = box_;
  const double middle = (box[4] + box[5]) / 2;
  for (auto* z : {&box[4], &box[5]}) *z = middle + (*z - middle) * actor_->GetScale()[2];
  renderer_->ResetCamera(box.data());
  fillWindow(box);
  renderer_->ResetCameraClippingRange();
}

// VTK leaves room for a sphere around the cloud: narrow the view until its box fills the window.
void CloudScene::fillWindow(const Box& box) {
  constexpr double kFilled = 0.94;
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double x = box[corner & 1];
    double y = box[2 + (corner >> 1 & 1)];
    double z = box[4 + (corner >> 2 & 1)];
    renderer_->WorldToView(x, y, z);
    reach = std::max({reach, std::abs(x), std::abs(y)});
  }
  if (!(reach > 0) || !std::isfinite(reach)) return;
  auto* camera = renderer_->GetActiveCamera();
  const double half = vtkMath::RadiansFromDegrees(camera->GetViewAngle() / 2);
  const double narrowed = std::atan(std::tan(half) * reach / kFilled);
  camera->SetViewAngle(2 * vtkMath::DegreesFromRadians(narrowed));
}

void CloudScene::handle(const QMouseEvent& event, unsigned long vtk_event) {
  const QPointF position = event.position() * view_.devicePixelRatioF();
  interactor_->SetEventInformationFlipY(static_cast<int>(position.x()),
                                        static_cast<int>(position.y()),
                                        event.modifiers() & Qt::ControlModifier ? 1 : 0,
                                        event.modifiers() & Qt::ShiftModifier ? 1 : 0);
  interactor_->InvokeEvent(vtk_event);
}

void CloudScene::handle(const QWheelEvent& event) {
  const QPointF position = event.position() * view_.devicePixelRatioF();
  interactor_->SetEventInformationFlipY(static_cast<int>(position.x()),
                                        static_cast<int>(position.y()));
  interactor_->InvokeEvent(event.angleDelta().y() > 0 ? vtkCommand::MouseWheelForwardEvent
                                                      : vtkCommand::MouseWheelBackwardEvent);
}

std::optional<std::size_t> CloudScene::pick(QPointF at) {
  const double ratio = view_.devicePixelRatioF();
  const int* size = window_->GetSize();
  picker_->SetTolerance(kPickReach * ratio / std::hypot(size[0], size[1]));
  if (picker_->Pick(at.x() * ratio, size[1] - 1 - at.y() * ratio, 0, renderer_) == 0) return {};
  const vtkIdType point = picker_->GetPointId();
  return point < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(point));
}

}  // namespace episcope
