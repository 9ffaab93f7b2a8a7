// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/cloud_scene.h"

#include "widgets/cloud/point_cloud_view.h"
#include "widgets/controls/theme.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkGenericRenderWindowInteractor.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkMath.h>
#include <vtkOpenGLState.h>
#include <vtkPlane.h>
#include <vtkPlaneCollection.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkStaticPointLocator.h>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope {
namespace {

constexpr int kPickReach = 5;  // logical pixels
/// Of the depth buffer: nothing is seen.
constexpr double kNothing = 1;

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

CloudScene::CloudScene(OffscreenGl& view)
    : view_(view), parts_(std::make_shared<const CloudParts>()), marks_(*renderer_) {
  window_->SetMultiSamples(0);  // With a software renderer, this is most of the time of a frame.
  window_->SetOwnContext(0);
  window_->SetFrameBlitModeToNoBlit();
  window_->AddRenderer(renderer_);
  const QColor background = theme::kCanvas;
  renderer_->SetBackground(background.redF(), background.greenF(), background.blueF());
  near_->SetNormal(0, 0, -1);  // the nearer a point, the larger its z
  far_->SetNormal(0, 0, 1);
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
  for (const auto& actor : actors_) actor->setPointSize(look_.point_size * ratio);
  marks_.setScale(ratio, height);
}

void CloudScene::paint() {
  if (wanted_direction_) applyDirection();
  auto* state = window_->GetState();
  state->Reset();
  state->Push();
  state->vtkglDepthFunc(GL_LEQUAL);  // Qt leaves GL_LESS.
  render();
  state->vtkglBindFramebuffer(GL_DRAW_FRAMEBUFFER, view_.defaultFramebufferObject());
  state->vtkglDisable(GL_SCISSOR_TEST);
  window_->BlitDisplayFramebuffer();
  state->Pop();
}

void CloudScene::render() {
  for (const auto& actor : actors_) actor->drawFew(is_moving_);
  window_->SetReadyForRendering(true);
  window_->Render();
  window_->SetReadyForRendering(false);
}

bool CloudScene::isCurrent() const {
  return view_.context() != nullptr && QOpenGLContext::currentContext() == view_.context();
}

// Only if needed: doing it again would bind Qt's framebuffer in the middle of a frame.
void CloudScene::makeCurrent(void*) {
  if (!isCurrent()) view_.makeCurrent();
}

void CloudScene::askForFrame(void*) {
  view_.update();
}

void CloudScene::setLook(const CloudLook& look) {
  look_ = look;
  applyLook();
}

std::size_t CloudScene::size() const {
  std::size_t points = 0;
  for (const CloudPart& part : *parts_) points += part.all.positions.size();
  return points;
}

void CloudScene::setParts(CloudPartsPtr parts) {
  actors_.clear();  // they draw the memory of the former parts
  locators_.assign(parts->size(), nullptr);
  parts_ = std::move(parts);
  box_ = {};
  bool is_first = true;
  for (const CloudPart& part : *parts_) {
    if (part.all.positions.empty()) continue;
    const Box box = robust_bounds(part.all);
    for (std::size_t i = 0; i < box.size(); ++i) {
      const bool is_low = i % 2 == 0;
      box_[i] = is_first ? box[i] : is_low ? std::min(box_[i], box[i]) : std::max(box_[i], box[i]);
    }
    is_first = false;
  }
  for (const CloudPart& part : *parts_) {
    actors_.push_back(std::make_unique<CloudActor>(part, *renderer_));
  }
  applyLook();
}

// The z-stretch keeps the middle of the clouds where it is.
CloudScene::Place CloudScene::middle() const {
  return {(box_[0] + box_[1]) / 2, (box_[2] + box_[3]) / 2, (box_[4] + box_[5]) / 2};
}

CloudScene::Box CloudScene::stretched(Box box) const {
  const double z = middle()[2];
  for (auto* side : {&box[4], &box[5]}) *side = z + (*side - z) * look_.z_stretch;
  return box;
}

void CloudScene::applyLook() {
  const Box box = stretched(box_);
  clip_->RemoveAllItems();
  const auto depth = [&box](double part) { return box[5] + part * (box[4] - box[5]); };
  near_->SetOrigin(0, 0, depth(look_.clip_near));
  far_->SetOrigin(0, 0, depth(look_.clip_far));
  if (look_.clip_near > 0) clip_->AddItem(near_);
  if (look_.clip_far < 1) clip_->AddItem(far_);
  for (const auto& actor : actors_) {
    actor->setStretch(look_.z_stretch, middle());
    actor->setPointSize(look_.point_size * view_.devicePixelRatioF());
    actor->setShaded(look_.is_shaded);
    actor->setClip(*clip_);
  }
  placeMark();
  renderer_->ResetCameraClippingRange();
}

void CloudScene::setMarkedPixel(std::optional<PixelIndex> pixel) {
  marked_ = pixel;
  placeMark();
}

void CloudScene::setMarkedPlaces(std::vector<Place> places) {
  marked_places_ = std::move(places);
  placeMark();
}

void CloudScene::setNamedMarks(std::vector<CloudMark> marks) {
  named_ = std::move(marks);
  placeMark();
}

CloudScene::Place CloudScene::stretched(const Place& place) const {
  const double z = middle()[2];
  return {place[0], place[1], z + (place[2] - z) * look_.z_stretch};
}

// Pixels of a cloud stand in the order of rows.
void CloudScene::placeMark() {
  std::vector<Place> places;
  const auto before = [](const PixelIndex& a, const PixelIndex& b) {
    return std::pair(a.y, a.x) < std::pair(b.y, b.x);
  };
  for (const CloudPart& part : *parts_) {
    if (!marked_) break;
    const auto& pixels = part.all.pixels;
    const auto found = std::lower_bound(pixels.begin(), pixels.end(), *marked_, before);
    if (found == pixels.end() || *found != *marked_) continue;
    const auto& [x, y, z] = part.all.positions[static_cast<std::size_t>(found - pixels.begin())];
    places.push_back(stretched(Place{x, y, z}));
  }
  for (const Place& place : marked_places_) places.push_back(stretched(place));
  marks_.setCrosses(places);
  std::vector<CloudMark> named = named_;
  for (CloudMark& mark : named) mark.at = stretched(mark.at);
  marks_.setNamed(named);
}

void CloudScene::applyDirection() {
  const auto [azimuth, elevation] = *std::exchange(wanted_direction_, std::nullopt);
  auto* camera = renderer_->GetActiveCamera();
  camera->SetViewAngle(30);
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(0, 0, 1);
  camera->SetViewUp(0, 1, 0);
  camera->Azimuth(azimuth);
  camera->Elevation(elevation);
  camera->OrthogonalizeViewUp();
  auto box = stretched(box_);
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

// Position of the nearest drawn surface or point at a place, in device pixels from below.
std::optional<CloudScene::Place> CloudScene::seenAt(int x, int y) {
  const int reach = static_cast<int>(std::lround(kPickReach * view_.devicePixelRatioF()));
  const int* size = window_->GetSize();
  const int left = std::max(x - reach, 0);
  const int right = std::min(x + reach, size[0] - 1);
  const int low = std::max(y - reach, 0);
  const int high = std::min(y + reach, size[1] - 1);
  if (left > right || low > high) return std::nullopt;
  vtkNew<vtkFloatArray> depths;
  window_->GetZbufferData(left, low, right, high, depths);
  double nearest = std::numeric_limits<double>::infinity();
  Place seen{};
  vtkIdType i = 0;
  for (int row = low; row <= high; ++row) {
    for (int column = left; column <= right; ++column, ++i) {
      const double depth = depths->GetValue(i);
      const double distance = std::hypot(column - x, row - y);
      if (depth >= kNothing || distance > reach || distance >= nearest) continue;
      nearest = distance;
      seen = {column + 0.5, row + 0.5, depth};
    }
  }
  if (!std::isfinite(nearest)) return std::nullopt;
  renderer_->SetDisplayPoint(seen.data());
  renderer_->DisplayToWorld();
  const double* world = renderer_->GetWorldPoint();
  return Place{world[0] / world[3], world[1] / world[3], world[2] / world[3]};
}

vtkStaticPointLocator& CloudScene::locator(std::size_t part) {
  auto& locator = locators_[part];
  if (!locator) {
    locator = vtkSmartPointer<vtkStaticPointLocator>::New();
    locator->SetDataSet(&actors_[part]->points());
    locator->BuildLocator();
  }
  return *locator;
}

std::optional<PickedPoint> CloudScene::pick(QPointF at) {
  if (size() == 0 || !view_.context()) return std::nullopt;
  view_.makeCurrent();
  setMoving(false);  // what is picked is among all points
  render();
  const QPointF device = at * view_.devicePixelRatioF();
  auto seen = seenAt(static_cast<int>(device.x()),
                     window_->GetSize()[1] - 1 - static_cast<int>(device.y()));
  view_.doneCurrent();
  if (!seen) return std::nullopt;
  const double z = middle()[2];
  (*seen)[2] = z + ((*seen)[2] - z) / look_.z_stretch;
  std::optional<PickedPoint> picked;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t part = 0; part < parts_->size(); ++part) {
    const auto& positions = (*parts_)[part].all.positions;
    if (positions.empty()) continue;
    const vtkIdType point = locator(part).FindClosestPoint(seen->data());
    const auto& [px, py, pz] = positions[static_cast<std::size_t>(point)];
    const double distance = std::hypot(px - (*seen)[0], py - (*seen)[1], pz - (*seen)[2]);
    if (distance >= least) continue;
    least = distance;
    picked = PickedPoint{part, static_cast<std::size_t>(point)};
  }
  return picked;
}

}  // namespace episcope
