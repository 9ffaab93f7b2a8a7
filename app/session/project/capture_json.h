// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/capture/capture_work.h"

#include <filesystem>
#include <string>

namespace episcope {

/// What a project file holds of CaptureWork, as JSON: the lens with its photographs, settings,
/// rows, and objects with pairs and poses. Files are named relative to the folder of `project`
/// where that is possible.
[[nodiscard]] std::string capture_to_json(const CaptureWork& work,
                                          const std::filesystem::path& project);

/// Reads it back; also the form of earlier versions, which had one object and no lens. Throws
/// nlohmann's exception or InvalidInput for what is no such JSON.
[[nodiscard]] CaptureWork capture_from_json(const std::string& json,
                                            const std::filesystem::path& project);

}  // namespace episcope
