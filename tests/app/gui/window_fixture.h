// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/main_window.h"
#include "app/gui/scene/document_controller.h"
#include "app/gui/scene/overlay.h"
#include "app/gui/scene/scene_opener.h"
#include "app/gui/scene/viewer_area.h"
#include "app/gui/shell/commands.h"
#include "app/gui/shell/frame.h"
#include "app/gui/shell/jobs.h"
#include "app/session/session.h"
#include "engine/scenes/builtin.h"
#include "tests/patience.h"

#include <QPoint>
#include <QString>
#include <QTemporaryDir>

namespace episcope {

/// The only object of a class in a window: a panel, or the controller of a feature.
template <class T>
[[nodiscard]] T& find(const QWidget& window) {
  T* found = window.findChild<T*>();
  if (!found) qFatal("the window has no %s", T::staticMetaObject.className());
  return *found;
}

/// The window that ships, with settings and cache in a folder of their own, and small light fields
/// to open.
class WindowFixture {
 public:
  WindowFixture();

  /// Writes a built-in scene in archive form; returns the path of its lf.h5.
  QString writeScene(const std::string& id, const scenes::RenderOptions& options) const;
  /// 9×9 views of 96×96 pixels, with truth.
  [[nodiscard]] static scenes::RenderOptions smallOptions();

  /// Opens a built-in scene of this size and waits until methods can run on it.
  void openScene(const std::string& id, const scenes::RenderOptions& options);
  /// Opens a scene of `smallOptions` and waits until it is shown.
  void openSmall(const std::string& id = "edge");
  /// Clicks Run and waits for the result.
  void runAndWait();

  [[nodiscard]] const AnnotationDocument& document() { return *window.bench().document.document(); }
  [[nodiscard]] ViewIndex view() { return window.bench().session.view(); }
  /// Whether the view has its final labels, and nothing is on its way that would give others.
  [[nodiscard]] bool isSegmented();

  [[nodiscard]] ViewCanvas* canvas() const { return window.bench().viewer_area.canvas(); }
  /// Runs a command, which must be enabled.
  void trigger(const char* id);
  /// Types a key with the focus on the view.
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  /// Where a pixel of the view is on the canvas.
  [[nodiscard]] QPoint at(PixelIndex pixel) const;
  /// The mouse on pixels of the view.
  void press(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton,
             Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  void move(PixelIndex pixel);
  void release(PixelIndex pixel, Qt::MouseButton button = Qt::LeftButton);
  void drag(PixelIndex from, PixelIndex to, Qt::MouseButton button = Qt::LeftButton,
            Qt::KeyboardModifiers modifiers = Qt::NoModifier);
  /// Clicks the middle of a control.
  void click(const QString& object_name);

  [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }

 private:
  QTemporaryDir folder_;

 public:
  MainWindow window;
};

}  // namespace episcope
