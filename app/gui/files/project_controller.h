// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/commands.h"
#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/open_scene.h"
#include "app/session/user_folders.h"

#include <QMessageBox>
#include <QObject>
#include <QPointer>
#include <QString>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

class QComboBox;

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

/// Asks once before losing results and labels that somebody asked for, scribbles of other scenes,
/// project changes or running work; offers to save a project.
class ProjectGuard : public QObject {
  Q_OBJECT

 public:
  ProjectGuard(const Workbench& bench, ProjectController& project);

 private:
  using Continue = LeaveGuards::Continue;

  /// What would be lost.
  struct Loss {
    std::vector<std::string> results;
    std::vector<std::string> scribbled;  ///< Names of light fields,
    std::vector<std::string> picked;     ///< of those with pairs for ground truth,
    std::vector<std::string> measured;   ///< and of those with lines kept of EPIs.
    bool of_project = false;             ///< Other changes of a project that has a file.
    std::vector<std::string> running;    ///< Jobs, with their progress.
    [[nodiscard]] bool empty() const { return !has_unsaved() && running.empty(); }
    [[nodiscard]] bool has_unsaved() const {
      return !results.empty() || !scribbled.empty() || !picked.empty() || !measured.empty() ||
             of_project;
    }
  };

  [[nodiscard]] Loss loss(Leaving what) const;
  void addResults(const OpenScene& scene, Loss& loss) const;
  [[nodiscard]] std::vector<Jobs::Running> running(Leaving what) const;
  [[nodiscard]] static QString sentence(const Loss& loss);
  void ask(Leaving what, const Continue& go_on);
  void answer(QMessageBox::StandardButton button, Leaving what, const Continue& go_on);

  Workbench bench_;
  ProjectController& project_;
  std::size_t settled_jobs_ = 0;  // that ran when the user said so:
  bool is_settled_ = false;       // what is there now may go
  QPointer<QMessageBox> question_;
};

/// The list of open light fields, which switches between them.
class SceneChooser : public QObject {
  Q_OBJECT

 public:
  explicit SceneChooser(const Workbench& bench);

 private:
  void addCommands();
  void fill();

  Workbench bench_;
  QComboBox* list_;
};

/// Titles the window after light field and project; a star marks unsaved scribbles or project
/// changes.
class WindowTitle : public QObject {
  Q_OBJECT

 public:
  WindowTitle(const Workbench& bench, const Autosave& autosave, const ProjectController& project);

 private:
  void show();
  void mark();

  Workbench bench_;
  const Autosave& autosave_;
  const ProjectController& project_;
};

}  // namespace episcope
