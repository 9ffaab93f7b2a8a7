// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "app/session/document/annotation_journal.h"
#include "app/session/project/project.h"

#include <QStringList>

#include <filesystem>
#include <map>
#include <vector>

namespace episcope {

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
