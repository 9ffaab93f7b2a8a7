// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/main_window.h"
#include "engine/scenes/builtin.h"

#include <QString>
#include <QTemporaryDir>

#include <memory>

namespace episcope {

/// The window that ships, with settings and cache in a folder of their own, and small light fields
/// to open.
class WindowFixture {
 public:
  WindowFixture();

  /// Writes a built-in scene in archive form; returns the path of its lf.h5.
  QString writeScene(const std::string& id, const scenes::RenderOptions& options) const;
  /// 9×9 views of 96×96 pixels, with truth.
  [[nodiscard]] static scenes::RenderOptions smallOptions();

  /// Opens a scene and waits until it is shown.
  void openSmall(const std::string& id = "edge");
  /// Clicks Run and waits for the result.
  void runAndWait();

  [[nodiscard]] QString path(const QString& name) const { return folder_.filePath(name); }

 private:
  QTemporaryDir folder_;

 public:
  MainWindow window;
};

}  // namespace episcope
