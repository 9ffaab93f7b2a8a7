// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/core/progress.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace episcope::accuracy {

/// A method with some parameters set.
struct AblationVariant {
  std::string name;
  ParameterSet values;
};

/// A method and its variants; the first is what the others are compared with.
struct AblatedMethod {
  std::string method;
  std::vector<AblationVariant> variants;
};

/// Which parts of methods are worth what, on which scenes.
struct Ablation {
  std::string set;                  ///< Of scenes, as it is called in `README.md`.
  std::vector<std::string> scenes;  ///< As scenes::read_request takes them.
  std::vector<AblatedMethod> methods;
};

/// Reads an ablation from JSON: `set`, `scenes`, `methods` (each with `method` and `variants`:
/// `name` and `parameters` as texts). Throws InvalidInput for what no method takes.
[[nodiscard]] Ablation read_ablation(const std::filesystem::path& file);

/// Runs every variant on every scene in the center view and hands out a Markdown table for each
/// method as soon as it is known: MSE × 100 by scene; before them the geometric mean of the ratios
/// to the first variant, in how many scenes it is at least as good, and the mean BadPix(0.07).
void run_ablation(const Ablation& ablation, const std::function<void(const std::string&)>& print,
                  const Progress& progress);

}  // namespace episcope::accuracy
