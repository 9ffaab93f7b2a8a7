// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/segmentation.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Whether probabilities are written with the labels: four bytes for each ray and label.
enum class StoredProbabilities { None, All };

/// Writes labels with their names and colours, and probabilities, as `io::write_segmentation` does.
/// `input` is what opens the light field. A labeling without probabilities is written without.
/// Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& input, StoredProbabilities probabilities,
                        const Progress& progress);

/// A view of a file that `write_segmentation` wrote, or of another file with LABELS: the middle one
/// unless another is asked for. Throws IoError, InvalidInput for a view that the file does not
/// hold.
[[nodiscard]] Segmentation read_segmentation(const std::filesystem::path& path,
                                             std::optional<ViewIndex> view);

/// A view of the first file of label probabilities of the archive that lies beside the light field;
/// its labels count from 1. Throws InvalidInput, naming the light field, if there is no such file
/// or view, IoError.
[[nodiscard]] LabelingPtr read_archive_probabilities(const Scene& scene, ViewIndex view);

}  // namespace episcope
