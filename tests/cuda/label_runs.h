// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/isa.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace episcope::cuda_tests {

/// Something of the labeler that computes on either device, prepared so that it can be run.
struct LabelRun {
  std::string title;  ///< "labels rayspace, 11 labels"
  /// Labels of all rays, or other bytes that tell whether two results are equal.
  std::function<std::vector<std::uint8_t>(Device)> run;
  double share = 1;  ///< Of the bytes, what must be equal on both devices.
};

/// Of the labels of two devices, what must be equal.
inline constexpr double kLabelShare = 0.999;

/// Labels of a scene from probabilities that are mistaken in 30 % of the rays, within each view and
/// along the rays; and the whole labeler from strokes and the true disparity, where this build has
/// it. The scene must have true labels and disparity; it must outlive the runs.
[[nodiscard]] std::vector<LabelRun> label_runs(const Scene& scene);

/// The votes of a forest of 96 seeded trees on random features, of `views` views of `size`² pixels.
[[nodiscard]] LabelRun forest_run(int size, int views);

/// The labeler from strokes along the true labels of the center view; without run in builds without
/// OpenCV.
[[nodiscard]] LabelRun whole_labeler(const Scene& scene);

}  // namespace episcope::cuda_tests
