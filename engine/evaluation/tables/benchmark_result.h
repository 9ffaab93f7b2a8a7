// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"
#include "engine/evaluation/metrics/metrics.h"

#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// The result of one entry (a method of this build with its default parameters, an external
/// submission, or a way to label) on one scene. Disparities are evaluated in the centre view.
struct BenchmarkResult {
  std::string entry;
  std::string scene;
  bool is_foreign = false;     ///< Submitted from elsewhere.
  double seconds = 0;          ///< Wall-clock time; 0 = not given.
  bool has_all_views = false;  ///< Whether `seconds` are those of all views.
  Metrics vmv2013;             ///< Empty if there is nothing to judge or to judge against.
  Metrics benchmark2016;       ///< Likewise; also of views smaller than two borders of 15 px.
  Metrics labels;              ///< Of labels, see label_tables.h; empty for disparities.
  std::string problem;         ///< Why a score is missing, a sentence; empty = none is.
  bool has_failed = false;     ///< The method or the submission failed, not the scene.
  std::vector<std::string> notes;
};

/// One point of a parameter search on one scene.
struct SearchResult {
  std::string method;
  std::string scene;
  ParameterSet point;  ///< The parameters that are searched.
  std::optional<double> mse_100;
  double seconds = 0;
  std::string problem;
};

}  // namespace episcope
