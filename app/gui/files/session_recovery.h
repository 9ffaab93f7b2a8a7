// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"
#include "app/gui/shell/workbench.h"
#include "app/session/annotation_journal.h"
#include "app/session/project_file.h"
#include "app/session/workspace.h"

#include <QObject>
#include <QStringList>

#include <filesystem>
#include <map>
#include <vector>

namespace episcope {

class Autosave;
class MessageBar;

/// Offers scenes, results and scribbles of a session that ended unexpectedly, in a bar that does
/// not block.
class SessionRecovery : public QObject {
  Q_OBJECT

 public:
  SessionRecovery(const Workbench& bench, Autosave& autosave);

  /// Looks for workspaces in the background and offers the latest.
  void look();

 private:
  void offerNext();
  void recover(const OrphanedWorkspace& left);
  void takeOver(const OrphanedWorkspace& left);

  Workbench bench_;
  Autosave& autosave_;
  MessageBar* bar_;
  std::vector<OrphanedWorkspace> left_;  // the one to be offered next comes last
  LatestJob job_;
};

/// A project as read by a worker.
struct ReadProject {
  Project project;
  std::map<std::size_t, RecoveredAnnotation> strokes;  ///< By the place of their scene.
  QStringList failures;                                ///< Sentences on strokes that are damaged.
};

/// Reads the strokes of a project.
void read_strokes(ReadProject& read);

/// Origin of a project.
enum class ProjectOrigin {
  File,   ///< A project file, which replaces everything open.
  Crash,  ///< A crashed session, unsaved; scenes opened since then stay.
};

/// Opens the scenes of a project and shows the current one. Returns the stroke files that have
/// journals again.
std::vector<std::filesystem::path> show_project(const Workbench& bench, ReadProject read,
                                                ProjectOrigin origin);

}  // namespace episcope
