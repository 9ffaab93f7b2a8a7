// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

namespace episcope {

class CaptureDocuments;
class Session;

/// What is known of the pose of the current object, or what it lacks.
[[nodiscard]] QString pose_text(const Session& session, const CaptureDocuments& documents);

}  // namespace episcope
