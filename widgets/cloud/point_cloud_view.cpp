// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud_view.h"

#include "widgets/cloud/cloud_scene.h"
#include "widgets/controls/layout.h"

#include <vtkCommand.h>
#include <vtkVersion.h>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QLabel>
#include <QLineF>
#include <QMouseEvent>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <QPainter>
#include <QWheelEvent>

#include <utility>

namespace episcope {
namespace {

constexpr double kClickReach = 3;  // logical pixels; a longer way is a drag
constexpr int kStillAfter_ms = 250;
constexpr qint64 kFluent_ms = 30;  // a frame that takes longer is drawn with few points

// Text shown without OpenGL.
QString no_gl_text() {
  return OffscreenGl::tr(
      "There is no 3D view: this session has no display with OpenGL. Export the result as PLY to "
      "see it elsewhere.");
}

}  // namespace

PointCloudView::PointCloudView(QWidget* parent)
    : OffscreenGl(parent), scene_(std::make_unique<CloudScene>(*this)) {
  setObjectName("pointCloudView");
  setFocusPolicy(Qt::NoFocus);  // the keyboard stays with the light field
  setMouseTracking(true);
  setMinimumSize(120, 90);
  setAccessibleName(tr("3D view"));
  still_.setSingleShot(true);
  still_.setInterval(kStillAfter_ms);
  connect(&still_, &QTimer::timeout, this, [this] {
    if (!scene_->isMoving()) return;
    scene_->setMoving(false);
    update();
  });
}

PointCloudView::~PointCloudView() {
  if (!context()) return;
  makeCurrent();
  scene_->finalize();
  doneCurrent();
}

void PointCloudView::initializeGL() {
  scene_->initialize();
}

void PointCloudView::paintGL() {
  QElapsedTimer timer;
  timer.start();
  scene_->paint();
  // What VTK left in alpha would let the window behind shine through.
  auto* gl = context()->functions();
  gl->glBindFramebuffer(GL_FRAMEBUFFER, defaultFramebufferObject());
  gl->glDisable(GL_SCISSOR_TEST);
  gl->glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  gl->glClearColor(0, 0, 0, 1);
  gl->glClear(GL_COLOR_BUFFER_BIT);
  gl->glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  if (scene_->isMoving()) return;
  gl->glFinish();
  full_frame_ms_ = timer.elapsed();
}

void PointCloudView::setParts(CloudPartsPtr parts) {
  // VTK frees what it keeps of the former parts in the context.
  if (context()) makeCurrent();
  scene_->setParts(std::move(parts));
  if (context()) doneCurrent();
  if (!is_turned_) showPreset(preset_);
  update();
}

void PointCloudView::setCloud(PointCloud cloud) {
  auto parts = std::make_shared<CloudParts>();
  parts->push_back({std::move(cloud), {}});
  setParts(std::move(parts));
}

void PointCloudView::setLook(const CloudLook& look) {
  if (!(look.z_stretch > 0) || look == scene_->look()) return;
  scene_->setLook(look);
  beginMoving();
  update();
}

void PointCloudView::setMarkedPixel(std::optional<PixelIndex> pixel) {
  scene_->setMarkedPixel(pixel);
  beginMoving();
  update();
}

void PointCloudView::setMarkedPlaces(const std::vector<std::array<double, 3>>& places) {
  scene_->setMarkedPlaces(places);
  beginMoving();
  update();
}

void PointCloudView::setNamedMarks(const std::vector<CloudMark>& marks) {
  if (context()) makeCurrent();  // VTK frees the textures of former names
  scene_->setNamedMarks(marks);
  if (context()) doneCurrent();
  beginMoving();
  update();
}

void PointCloudView::setLegend(const QString& title, const render::Shading& shading) {
  scene_->marks().setLegend(title, shading);
  update();
}

std::size_t PointCloudView::pointCount() const {
  return scene_->size();
}

const CloudLook& PointCloudView::look() const {
  return scene_->look();
}

bool PointCloudView::isMoving() const {
  return scene_->isMoving();
}

void PointCloudView::beginMoving() {
  if (full_frame_ms_ > kFluent_ms) scene_->setMoving(true);
  still_.start();
}

void PointCloudView::showPreset(CloudPreset preset) {
  preset_ = preset;
  is_turned_ = false;
  switch (preset) {
    case CloudPreset::Front:
      scene_->lookFrom(0, 0);
      break;
    case CloudPreset::Tilted:
      scene_->lookFrom(-28, 22);
      break;
    case CloudPreset::Side:
      scene_->lookFrom(-85, 8);
      break;
  }
  update();
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
    if (const auto at = scene_->pick(event.position())) emit pointPicked(at->point, at->part);
  }
  return true;
}

bool PointCloudView::event(QEvent* event) {
  switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonRelease:
      return handleMouse(static_cast<const QMouseEvent&>(*event));
    case QEvent::MouseMove: {
      const auto& moved = static_cast<const QMouseEvent&>(*event);
      if (moved.buttons() != Qt::NoButton) beginMoving();
      is_turned_ |= moved.buttons() != Qt::NoButton;
      scene_->handle(moved, vtkCommand::MouseMoveEvent);
      if (press_ && QLineF(*press_, moved.position()).length() > kClickReach) press_.reset();
      return true;
    }
    case QEvent::Wheel:
      beginMoving();
      is_turned_ = true;
      scene_->handle(static_cast<const QWheelEvent&>(*event));
      return true;
    case QEvent::MouseButtonDblClick:
      resetCamera();
      return true;
    case QEvent::Resize: {
      const bool done = QWidget::event(event);
      scene_->resize();
      if (!is_turned_) showPreset(preset_);  // fills the new size
      return done;
    }
    default:
      return QWidget::event(event);
  }
}

QWidget* make_point_cloud_view(QWidget* parent) {
  if (QGuiApplication::platformName() != "offscreen" &&
      QGuiApplication::platformName() != "minimal") {
    return new PointCloudView(parent);
  }
  auto* label = named("pointCloudUnavailable", new QLabel(no_gl_text(), parent));
  label->setAlignment(Qt::AlignCenter);
  label->setWordWrap(true);
  return label;
}

OffscreenGl::OffscreenGl(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
}

OffscreenGl::~OffscreenGl() {
  if (!context_) return;
  makeCurrent();
  frame_.reset();
  doneCurrent();
}

QImage OffscreenGl::grabFramebuffer() {
  if (!prepare()) return {};
  paintGL();
  QImage picture = frame_->toImage().convertToFormat(QImage::Format_RGB32);
  doneCurrent();
  picture.setDevicePixelRatio(devicePixelRatioF());
  emit frameDrawn();
  return picture;
}

void OffscreenGl::makeCurrent() {
  if (context_) context_->makeCurrent(&surface_);
}

void OffscreenGl::doneCurrent() {
  if (context_) context_->doneCurrent();
}

unsigned int OffscreenGl::defaultFramebufferObject() const {
  return frame_ ? frame_->handle() : 0;
}

void OffscreenGl::paintEvent(QPaintEvent*) {
  const QImage picture = grabFramebuffer();
  QPainter painter(this);
  if (!picture.isNull()) return painter.drawImage(0, 0, picture);
  painter.fillRect(rect(), palette().window());
  painter.drawText(rect(), Qt::AlignCenter | Qt::TextWordWrap, no_gl_text());
}

// The context is current afterwards, with a framebuffer of the widget's size.
bool OffscreenGl::prepare() {
  const bool is_new = !context_;
  if (!makeContext()) return false;
  makeCurrent();
  const QSize size = (QSizeF(this->size()) * devicePixelRatioF()).toSize().expandedTo({1, 1});
  if (!frame_ || frame_->size() != size) {
    frame_ = std::make_unique<QOpenGLFramebufferObject>(
        size, QOpenGLFramebufferObject::CombinedDepthStencil);
  }
  if (is_new) initializeGL();
  frame_->bind();
  return true;
}

bool OffscreenGl::makeContext() {
  if (context_) return true;
  if (is_unavailable_) return false;
  surface_.create();
  auto context = std::make_unique<QOpenGLContext>();
  is_unavailable_ = !context->create() || !context->makeCurrent(&surface_);
  if (!is_unavailable_) context_ = std::move(context);
  return !is_unavailable_;
}

std::string vtk_version() {
  return vtkVersion::GetVTKVersion();
}

}  // namespace episcope

#include "moc_point_cloud_view.cpp"
