// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"
#include "engine/disparity/estimator.h"

#include <string>
#include <vector>

namespace episcope::cuda_tests {

/// One method in one profile on one scene.
struct Case {
  Estimator estimator;
  ParameterSet values;
  std::string title;  ///< "epi_l", "epi_l paper"
  ViewSelection views = ViewSelection::All;
};

/// How closely a method on the device must follow the CPU.
enum class Kind {
  Local,     ///< 99.99 % of the pixels within 1e-4 px.
  Learned,   ///< 99.9 % of the pixels within 1e-3 px.
  Iterative  ///< MSE within 0.5 %: both stop at the same gap, on different ways.
};
[[nodiscard]] Kind kind_of(const Estimator& estimator);

/// Every method that computes on a GPU whose id begins with `filter`, in each of its profiles, and
/// for the center view alone; the learned one also with the mean of both surfaces of a pixel.
[[nodiscard]] std::vector<Case> cases(const std::string& filter);

/// Names of the built-in scenes compared on: flat, slanted, cluttered, noisy, invalid pixels, grids
/// of few, of many and of an even number of views, other types of samples.
[[nodiscard]] std::vector<std::string> scene_texts();

/// A scene by its text (engine/scenes/builtin.h), with views of about `size`² pixels. Before the
/// text may stand "masked:", for the corners of every view to be marked as invalid, "grey:" for one
/// channel of 16 bits and "float:".
[[nodiscard]] Scene make_scene(const std::string& text, int size);

/// Things with 13 labels, in views of size² pixels.
[[nodiscard]] Scene make_label_scene(int size);

}  // namespace episcope::cuda_tests
