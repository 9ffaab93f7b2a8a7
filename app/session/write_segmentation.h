// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/segmentation.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <string>

namespace episcope {

/// Writes labels and probabilities as `io::write_labeling` does. `source` is what opens the light
/// field again. Precondition: there is a labeling. Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& source, const Progress& progress);

}  // namespace episcope
