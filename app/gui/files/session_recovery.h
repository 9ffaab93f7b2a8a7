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

/// Offers the scenes and results of a session that ended unexpectedly, with what was painted on
/// them, in a bar that blocks nothing.
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

/// A project as it is read by a worker.
struct ReadProject {
  Project project;
  std::map<std::size_t, RecoveredAnnotation> strokes;  ///< By the place of their scene.
  QStringList failures;                                ///< Sentences on strokes that are damaged.
};

/// Reads the strokes that a project names.
void read_strokes(ReadProject& read);

/// Where a project comes from.
enum class ProjectOrigin {
  File,   ///< Of the user's: it takes the place of all that is open.
  Crash,  ///< Nothing of it is saved; what else was opened meanwhile stays.
};

/// Opens the scenes of a project and shows the current one. Returns the files of strokes that are
/// in journals of their own again.
std::vector<std::filesystem::path> show_project(const Workbench& bench, ReadProject read,
                                                ProjectOrigin origin);

}  // namespace episcope
