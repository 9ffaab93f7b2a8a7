// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge.h"
#include "app/session/segmentation.h"
#include "engine/core/estimate.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// Files of a benchmark, named below its folder. All are written atomically; all functions that
/// write throw IoError.

/// "scenes/cotton/view.png": `what` may be "view", "truth", "labels".
[[nodiscard]] std::string scene_file(const std::string& scene, const std::string& what);
/// "scenes/cotton/epi_l-error.png": `what` may be "disparity", "error", "labels",
/// "wrong".
[[nodiscard]] std::string picture_file(const std::string& scene, const std::string& entry,
                                       const std::string& what);
/// "scenes/cotton/epi_l.h5".
[[nodiscard]] std::string map_file(const std::string& scene, const std::string& entry);

/// Writes pictures of the center view and of its true disparity; returns whether there is one.
bool write_scene_pictures(const std::filesystem::path& folder, const std::string& name,
                          const Scene& scene, Interval range);

/// Pictures of an estimate of the center view alone (`center_of`) and, unless `evaluation` is null,
/// of its error. Returns what was written.
std::vector<std::string> write_pictures(const std::filesystem::path& folder,
                                        const std::string& scene, const EstimatePtr& center,
                                        const std::string& entry, const EvaluationPtr& evaluation,
                                        Interval range);

/// Writes a picture of the true labels of the center view; returns whether it has any.
bool write_label_truth(const std::filesystem::path& folder, const std::string& name,
                       const Scene& scene);

/// Pictures of the labels of the center view and, where true labels are known, of what is wrong.
/// Returns what was written.
std::vector<std::string> write_label_pictures(const std::filesystem::path& folder,
                                              const std::string& name, const Scene& scene,
                                              const LabelingPtr& labeling,
                                              const std::string& entry);

/// The center view of an estimate, with a note if its seconds are for all views.
[[nodiscard]] Estimate center_of(const Estimate& estimate, ViewIndex center);

}  // namespace episcope
