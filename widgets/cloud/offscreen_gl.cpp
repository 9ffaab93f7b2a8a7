// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/offscreen_gl.h"

#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QPainter>

namespace episcope {

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

QString no_gl_text() {
  return OffscreenGl::tr(
      "There is no 3D view: this session has no display with OpenGL. Export the result as PLY to "
      "see it elsewhere.");
}

}  // namespace episcope

#include "moc_offscreen_gl.cpp"
