// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_view.h"

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
#include <vtkNew.h>
#include <vtkOpenGLState.h>
#include <vtkPointData.h>
#include <vtkPointPicker.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <QGuiApplication>
#include <QLabel>
#include <QLineF>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFunctions>
#include <QWheelEvent>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace episcope {
namespace {

constexpr double kPickReach = 5;   // logical pixels
constexpr double kClickReach = 3;  // a longer way is a drag

}  // namespace

/// Everything of VTK: one render window, one renderer, one actor, never shared.
class PointCloudView::Scene {
 public:
  using Box = std::array<double, 6>;  ///< x0, x1, y0, y1, z0, z1.

  explicit Scene(PointCloudView& view) : view_(view) {
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
    observe(window_, vtkCommand::WindowMakeCurrentEvent, &Scene::makeCurrent);
    observe(window_, vtkCommand::WindowIsCurrentEvent, &Scene::tellCurrent);
    observe(window_, vtkCommand::WindowSupportsOpenGLEvent, &Scene::tellSupported);
    observe(interactor_, vtkCommand::RenderEvent, &Scene::askForFrame);
    interactor_->Initialize();
  }

  void initialize() {
    window_->SetReadyForRendering(true);
    window_->SetMapped(1);
    window_->SetIsDirect(1);
    window_->SetForceMaximumHardwareLineWidth(1);
    window_->OpenGLInit();
    window_->SetReadyForRendering(false);
    resize();
  }

  void finalize() {
    window_->SetReadyForRendering(true);
    window_->Finalize();
    window_->SetReadyForRendering(false);
  }

  void resize() {
    const double ratio = view_.devicePixelRatioF();
    const int width = static_cast<int>(std::lround(view_.width() * ratio));
    const int height = static_cast<int>(std::lround(view_.height() * ratio));
    window_->SetDPI(static_cast<int>(std::lround(96 * ratio)));
    interactor_->UpdateSize(width, height);
    window_->SetSize(width, height);
    actor_->GetProperty()->SetPointSize(static_cast<float>(2 * ratio));
  }

  void paint() {
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

  void setCloud(const PointCloud& cloud);
  void setZStretch(double factor) {
    actor_->SetScale(1, 1, factor);
    renderer_->ResetCameraClippingRange();
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(points_->GetNumberOfPoints());
  }
  /// Takes effect with the next frame, when the size of the window is known.
  void look(double azimuth, double elevation) { wanted_look_ = {azimuth, elevation}; }
  void handle(const QMouseEvent& event, unsigned long vtk_event);
  /// The nearest point under a place of the widget, if there is one.
  [[nodiscard]] std::optional<std::size_t> pick(QPointF at);
  void handle(const QWheelEvent& event);

 private:
  template <class Subject>
  void observe(const Subject& subject, unsigned long event, void (Scene::*handler)(void*)) {
    struct Link {
      Scene* scene;
      void (Scene::*handler)(void*);
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

  [[nodiscard]] bool isCurrent() const {
    return view_.context() != nullptr && QOpenGLContext::currentContext() == view_.context();
  }
  // Only if needed: doing it again would bind Qt's framebuffer in the middle of a frame.
  void makeCurrent(void*) {
    if (!isCurrent()) view_.makeCurrent();
  }
  void tellCurrent(void* data) { *static_cast<bool*>(data) = isCurrent(); }
  void tellSupported(void* data) { *static_cast<int*>(data) = 1; }
  void askForFrame(void*) { view_.update(); }
  void applyLook();
  void fillWindow(const Box& box);

  PointCloudView& view_;
  Box box_{};  ///< Around the cloud, before the z-stretch.
  std::optional<std::pair<double, double>> wanted_look_;  ///< Azimuth, elevation in degrees.
  vtkNew<vtkGenericOpenGLRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkGenericRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleTrackballCamera> style_;
  vtkNew<vtkPolyData> points_;
  vtkNew<vtkPolyDataMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkPointPicker> picker_;
};

void PointCloudView::Scene::setCloud(const PointCloud& cloud) {
  const auto count = static_cast<vtkIdType>(cloud.positions.size());
  vtkNew<vtkFloatArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(count);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(count);
  vtkNew<vtkCellArray> cells;
  if (count > 0) {
    std::copy_n(cloud.positions.front().data(), 3 * count, coordinates->GetPointer(0));
    std::copy_n(cloud.colors.front().data(), 3 * count, colors->GetPointer(0));
    cells->InsertNextCell(static_cast<int>(count));
    for (vtkIdType i = 0; i < count; ++i) cells->InsertCellPoint(i);
  }
  vtkNew<vtkPoints> positions;
  positions->SetData(coordinates);
  points_->Initialize();
  points_->SetPoints(positions);
  points_->SetVerts(cells);
  points_->GetPointData()->SetScalars(colors);
  points_->Modified();
  box_ = robust_bounds(cloud);
  // The z-stretch keeps the middle of the cloud where it is.
  actor_->SetOrigin((box_[0] + box_[1]) / 2, (box_[2] + box_[3]) / 2, (box_[4] + box_[5]) / 2);
  renderer_->ResetCameraClippingRange();
}

void PointCloudView::Scene::applyLook() {
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
void PointCloudView::Scene::fillWindow(const Box& box) {
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

void PointCloudView::Scene::handle(const QMouseEvent& event, unsigned long vtk_event) {
  const QPointF position = event.position() * view_.devicePixelRatioF();
  interactor_->SetEventInformationFlipY(static_cast<int>(position.x()),
                                        static_cast<int>(position.y()),
                                        event.modifiers() & Qt::ControlModifier ? 1 : 0,
                                        event.modifiers() & Qt::ShiftModifier ? 1 : 0);
  interactor_->InvokeEvent(vtk_event);
}

void PointCloudView::Scene::handle(const QWheelEvent& event) {
  const QPointF position = event.position() * view_.devicePixelRatioF();
  interactor_->SetEventInformationFlipY(static_cast<int>(position.x()),
                                        static_cast<int>(position.y()));
  interactor_->InvokeEvent(event.angleDelta().y() > 0 ? vtkCommand::MouseWheelForwardEvent
                                                      : vtkCommand::MouseWheelBackwardEvent);
}

std::optional<std::size_t> PointCloudView::Scene::pick(QPointF at) {
  const double ratio = view_.devicePixelRatioF();
  const int* size = window_->GetSize();
  picker_->SetTolerance(kPickReach * ratio / std::hypot(size[0], size[1]));
  if (picker_->Pick(at.x() * ratio, size[1] - 1 - at.y() * ratio, 0, renderer_) == 0) return {};
  const vtkIdType point = picker_->GetPointId();
  return point < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(point));
}

PointCloudView::PointCloudView(QWidget* parent)
    : QOpenGLWidget(parent), scene_(std::make_unique<Scene>(*this)) {
  setObjectName("pointCloudView");
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(120, 90);
}

PointCloudView::~PointCloudView() {
  if (context()) disconnect(context(), nullptr, this, nullptr);
  releaseContext();
}

void PointCloudView::releaseContext() {
  if (!context()) return;
  makeCurrent();
  scene_->finalize();
  doneCurrent();
}

void PointCloudView::initializeGL() {
  // Also called again, with another context, after the widget got another window.
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &PointCloudView::releaseContext,
          Qt::UniqueConnection);
  scene_->initialize();
}

void PointCloudView::paintGL() {
  scene_->paint();
  // What VTK left in alpha would let the window behind shine through.
  auto* gl = context()->functions();
  gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
  gl->glDisable(GL_SCISSOR_TEST);
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void PointCloudView::setCloud(const PointCloud& cloud) {
  const bool was_empty = scene_->size() == 0;
  scene_->setCloud(cloud);
  if (was_empty) resetCamera();
  update();
}

void PointCloudView::setZStretch(double factor) {
  if (!(factor > 0)) return;
  scene_->setZStretch(factor);
  update();
}

std::size_t PointCloudView::pointCount() const {
  return scene_->size();
}

void PointCloudView::showPreset(CloudPreset preset) {
  switch (preset) {
    case CloudPreset::Front:
      scene_->look(0, 0);
      break;
    case CloudPreset::Tilted:
      scene_->look(-28, 22);
      break;
    case CloudPreset::Side:
      scene_->look(-85, 8);
      break;
  }
  update();
}

void PointCloudView::resetCamera() {
  showPreset(CloudPreset::Tilted);
}

bool PointCloudView::handleMouse(const QMouseEvent& event) {
  const bool is_press = event.type() == QEvent::MouseButtonPress;
  switch (event.button()) {
    case Qt::LeftButton:
      scene_->handle(
          event, is_press ? vtkCommand::LeftButtonPressEvent : vtkCommand::LeftButtonReleaseEvent);
      break;
    case Qt::MiddleButton:
      scene_->handle(event, is_press ? vtkCommand::MiddleButtonPressEvent
                                     : vtkCommand::MiddleButtonReleaseEvent);
      break;
    case Qt::RightButton:
      scene_->handle(event, is_press ? vtkCommand::RightButtonPressEvent
                                     : vtkCommand::RightButtonReleaseEvent);
      break;
    default:
      break;
  }
  if (event.button() != Qt::LeftButton) return true;
  const auto pressed = std::exchange(press_, std::nullopt);
  if (is_press) {
    press_ = event.position();
  } else if (pressed) {
    if (const auto point = scene_->pick(event.position())) emit pointPicked(*point);
  }
  return true;
}

bool PointCloudView::event(QEvent* event) {
  // QOpenGLWidget sends events from within its constructor, before there is a scene.
  if (!scene_) return QOpenGLWidget::event(event);
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
      return handleMouse(static_cast<const QMouseEvent&>(*event));
    case QEvent::MouseMove: {
      const auto& moved = static_cast<const QMouseEvent&>(*event);
      scene_->handle(moved, vtkCommand::MouseMoveEvent);
      if (press_ && QLineF(*press_, moved.position()).length() > kClickReach) press_.reset();
      return true;
    }
    case QEvent::Wheel:
      scene_->handle(static_cast<const QWheelEvent&>(*event));
      return true;
    case QEvent::MouseButtonDblClick:
      resetCamera();
      return true;
    case QEvent::Resize: {
      const bool done = QOpenGLWidget::event(event);
      scene_->resize();
      return done;
    }
    default:
      return QOpenGLWidget::event(event);
  }
}

QWidget* make_point_cloud_view(QWidget* parent) {
  if (QGuiApplication::platformName() != "offscreen" &&
      QGuiApplication::platformName() != "minimal") {
    return new PointCloudView(parent);
  }
  auto* label = new QLabel(
      PointCloudView::tr("There is no 3D view: this session has no display with OpenGL. Export the "
                         "result as PLY to see it elsewhere."),
      parent);
  label->setObjectName("pointCloudUnavailable");
  label->setAlignment(Qt::AlignCenter);
  label->setWordWrap(true);
  return label;
}

}  // namespace episcope

#include "moc_point_cloud_view.cpp"
