// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/annotation_journal.h"
#include "app/session/open_scene.h"
#include "app/session/project_file.h"
#include "app/session/project_store.h"
#include "engine/core/jobs.h"

#include <QObject>
#include <QStringList>
#include <QTimer>

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace episcope {

/// Keeps open scenes and results in a workspace, so that a crash loses none: results at once, the
/// rest soon after. Scribbles have their own journals.
class Autosave : public QObject {
  Q_OBJECT

 public:
  explicit Autosave(const Workbench& bench);
  /// Keeps the workspace, unless the window was closed with nothing to lose.
  ~Autosave() override;

  /// Folder of workspaces, initially the user's own; empty = keeps nothing.
  void setRoot(std::filesystem::path root) { root_ = std::move(root); }
  [[nodiscard]] const std::filesystem::path& root() const { return root_; }
  /// Continues with a workspace left by another session, unchanged until its scenes are open, and
  /// removes the present one. Throws IoError.
  void takeOver(const std::filesystem::path& folder);
  /// Sets the project file of the open scenes; empty = none yet.
  void setProjectFile(std::filesystem::path file);
  [[nodiscard]] const std::filesystem::path& projectFile() const { return project_file_; }
  /// Whether everything open is stored.
  [[nodiscard]] bool isIdle() const { return !is_writing_ && !is_due_; }

 signals:
  void projectFileChanged();

 private:
  /// What was written, even if the rest failed.
  struct Kept {
    std::vector<std::pair<int, std::filesystem::path>> results;  ///< Estimates and their files.
    struct Labels {
      std::uint64_t scene = 0;
      LabelingPtr labeling;
      std::filesystem::path file;
    };
    std::vector<Labels> labels;
  };
  static void write_all(Project project, const std::filesystem::path& file, Kept& kept,
                        const Progress& progress);
  void keepLabels(const Kept::Labels& kept);

  void follow(Parts parts);
  void schedule();
  void write();
  bool makeWorkspace();
  void finish(const Outcome<bool>& outcome, const Kept& kept);

  Workbench bench_;
  std::filesystem::path root_;
  std::filesystem::path project_file_;
  std::unique_ptr<Workspace> workspace_;
  std::vector<std::unique_ptr<Workspace>> former_;  // results may still be in their files alone
  std::map<std::uint64_t, std::filesystem::path> label_files_;  // of scenes, written here
  bool is_writing_ = false;
  bool is_due_ = false;
  bool is_over_ = false;  // the window was closed
  bool has_failed_ = false;
  QTimer later_;
  std::unique_ptr<JobRunner> runner_;
};

/// A project as read by a worker.
struct ReadProject {
  Project project;
  std::map<std::size_t, RecoveredAnnotation> strokes;  ///< By the place of their scene.
  QStringList failures;                                ///< Sentences on strokes that are damaged.
};

void read_strokes(ReadProject& read);

enum class ProjectOrigin {
  File,   ///< A project file, which replaces everything open.
  Crash,  ///< A crashed session, unsaved; scenes opened since then stay.
};

/// Opens the scenes of a project and shows the current one, then calls `shown`. Returns the stroke
/// files that have journals again.
std::vector<std::filesystem::path> show_project(const Workbench& bench, ReadProject read,
                                                ProjectOrigin origin,
                                                std::function<void()> shown = nullptr);

}  // namespace episcope
