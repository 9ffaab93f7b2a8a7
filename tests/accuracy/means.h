// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tests/accuracy/measure.h"

#include <vector>

namespace episcope::accuracy {

/// What one method does on average over scenes.
struct Mean {
  std::string group;
  std::string method;
  int scenes = 0;
  double geometric_mse_100 = 0;  ///< Of errors of at least kLeastMse, so that one 0 is not all.
  double mse_100 = 0;
  double geometric_mse_100_inset15 = 0;
  double badpix_0070 = 0;
  double seconds = 0;
};

/// MSE×100 below which a scene counts as solved.
inline constexpr double kLeastMse = 0.001;

/// Means of every method over the scenes of each group, and over all scenes as group `all`, in the
/// order in which they are met first.
[[nodiscard]] std::vector<Mean> means_of(const std::vector<Measurement>& measurements,
                                         const std::string& all);

/// A Markdown table of means.
[[nodiscard]] std::string means_table(const std::vector<Mean>& means);

}  // namespace episcope::accuracy
