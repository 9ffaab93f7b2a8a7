// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/disparity/estimator.h"

#include <string>

namespace episcope::accuracy {

/// How one method did on one scene; errors of the center view.
struct Measurement {
  std::string group;  ///< "choosing, thin": the set of scenes, and which part of it.
  std::string scene;
  std::string method;
  double mse_100 = 0;          ///< Protocol vmv2013, all pixels with truth.
  double mse_100_inset15 = 0;  ///< The same without a border of 15 px.
  double badpix_0070 = 0;      ///< Protocol benchmark2016, per cent.
  double seconds = 0;          ///< For `views` views.
  int views = 0;
  Interval range;  ///< That was searched,
  Interval truth;  ///< and that is there.
};

/// From the least to the largest true disparity of the center view, which the scene must have.
[[nodiscard]] Interval true_range(const Scene& scene);

/// Runs `estimator` with `values` over its defaults for all views if it can, or for the center view
/// alone. The scene must have truth for its center view. Throws as the estimator.
[[nodiscard]] Measurement measure(const std::string& name, const Scene& scene,
                                  const Estimator& estimator, const ParameterSet& values,
                                  ViewSelection views, const Progress& progress);

/// The head of a Markdown table of measurements, and a row.
[[nodiscard]] std::string table_head();
[[nodiscard]] std::string table_row(const Measurement& measurement);

}  // namespace episcope::accuracy
