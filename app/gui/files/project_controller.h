// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/user_folders.h"

#include <QObject>
#include <QString>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace episcope {

class Autosave;
struct Project;

/// Opens and saves projects.
class ProjectController : public QObject {
  Q_OBJECT

 public:
  ProjectController(const Workbench& bench, Autosave& autosave);

  /// Opens a project in place of everything open, once nothing would be lost.
  /// Calls `then` (may be null) once the project is open.
  void open(const QString& path, const std::function<void()>& then = nullptr);
  /// Saves to the project's file, or asks for one. Calls `then` on success.
  void save(std::function<void()> then = nullptr);
  void saveAs(std::function<void()> then = nullptr);
  /// Asks first if another program has written the file since.
  void saveTo(const QString& path, std::function<void()> then);
  /// Empty if there is none yet.
  [[nodiscard]] QString file() const;
  /// Whether the project has a file that lacks the current scenes and results.
  [[nodiscard]] bool hasChanged() const { return !file().isEmpty() && content() != saved_content_; }

 private:
  void addCommands();
  void saveWhatIsNew();
  void read(const QString& path, const std::function<void()>& then = nullptr);
  void write(const QString& path, std::function<void()> then);
  void noteSaved(const QString& path, const Project& written);
  void setFile(const QString& path);
  [[nodiscard]] QString suggestion() const;
  [[nodiscard]] std::string content() const;
  void locate(quint64 scene);
  void move(quint64 scene, const QString& input);

  Workbench bench_;
  Autosave& autosave_;
  KnownFiles known_;
  std::string saved_content_;  // what it holds
};

}  // namespace episcope
