// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/project/project.h"
#include "app/session/session.h"

namespace episcope {

/// The project that the open scenes make, without strokes. Results are held, not copied.
[[nodiscard]] Project project_of(const Session& session);

/// A scene of a project, on disk only. `is_saved`: the project is a file of the user's.
[[nodiscard]] OpenScene scene_of(const ProjectScene& scene, bool is_saved);

}  // namespace episcope
