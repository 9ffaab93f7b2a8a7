// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QImage>
#include <QOffscreenSurface>
#include <QWidget>

#include <memory>

class QOpenGLContext;
class QOpenGLFramebufferObject;

namespace episcope {

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

}  // namespace episcope
