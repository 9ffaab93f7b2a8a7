// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/labeling_inputs.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/labeler_parameters.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// Label probabilities of all views from a file of the archive. Its layers are the labels of
/// `painted` if there are as many, else 1, 2, …. Throws IoError; InvalidInput, naming the file, if
/// it covers one view only; Cancelled.
[[nodiscard]] LabelProbabilities read_all_probabilities(const std::filesystem::path& path,
                                                        const Scene& scene,
                                                        const Scribbles& painted,
                                                        const Progress& progress);

/// Writes the files of the archive that labels come from into a folder: the probabilities of edges
/// (edge_weights.h5), and those of labels by features of the image, with `estimate`, and with the
/// true disparity if the scene has it for all views. Returns their names. Throws InvalidInput as
/// the labeler, IoError, Cancelled.
std::vector<std::string> write_label_archive(const std::filesystem::path& folder,
                                             const Scene& scene, const Scribbles& painted,
                                             const LabelerParameters& parameters,
                                             const LabelingDisparity& estimate,
                                             const Progress& progress);

}  // namespace episcope
