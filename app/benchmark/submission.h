// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/scene.h"
#include "engine/io/models/map_reading.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Results of another program in a folder: a map for each scene, anywhere below it, named after the
/// scene (`cotton.pfm`, `disp_maps/cotton.h5`) or alone in a folder of that name
/// (`cotton/result.tif`); upper and lower case do not matter. Maps are of any form
/// that `read_result_of` reads. Seconds come from a result file, else from a text file named
/// after the scene (`runtimes/cotton.txt`, `cotton.txt`) whose first word is a number.

/// The folder's own name.
[[nodiscard]] std::string submission_name(const std::filesystem::path& folder);

/// Throws IoError unless `folder` is a folder.
void check_submission(const std::filesystem::path& folder);

/// The map for the light field of a scene, empty if the submission has none. Its notes tell whether
/// another reading fits far better (find_better_reading), or else whether values lie beyond ±20 px,
/// which no densely sampled light field has. Throws IoError, InvalidInput if it cannot be read, if
/// there are several, if size or views do not fit, or if the view holds no finite value.
[[nodiscard]] std::optional<Estimate> read_submission(const std::filesystem::path& folder,
                                                      const Scene& scene,
                                                      const io::MapReading& reading = {});

}  // namespace episcope
