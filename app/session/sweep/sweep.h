// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/run/run_estimator.h"
#include "engine/core/light_field/scene.h"
#include "engine/evaluation/metrics/metrics.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// A parameter with what is tried for it.
struct SweptParameter {
  std::string key;
  std::vector<ParameterValue> values;  ///< Ascending, see `parse_sweep_values`.
};

/// The points of a sweep: those of `search_grid` for these one or two parameters, all others as in
/// `base`. The first is that of `base` itself, whether or not it lies on the grid. A point holds
/// the swept parameters. Throws InvalidInput for more than `kMaxSearchPoints` of them.
[[nodiscard]] std::vector<ParameterSet> sweep_points(
    const std::vector<ParameterDescription>& descriptions, const ParameterSet& base,
    const std::vector<SweptParameter>& swept);

/// What a point found out.
struct SweepPoint {
  ParameterSet point{};    ///< The swept parameters.
  EstimatePtr estimate{};  ///< Of the centre view; null if the run failed or it was let go of.
  Interval display_range{};
  double seconds = 0;
  Metrics vmv2013{};        ///< Empty without ground truth.
  Metrics benchmark2016{};  ///< Likewise; also of small views, see `judge_by_both`.
  /// Median of |disparity − disparity of the first point| over pixels with a value in both, px.
  std::optional<double> change_px{};
  std::string problem{};  ///< Why it failed, a sentence; empty = it did not.
};

/// What a sweep found out on one light field.
struct SweepScene {
  std::uint64_t scene = 0;  ///< OpenScene::id.
  std::string name;         ///< Of the light field.
  /// In the order of `sweep_points`, as far as they are there.
  std::vector<SweepPoint> points{};
};

/// Whether points were judged.
[[nodiscard]] bool has_truth(const SweepScene& scene);

/// A method with a grid of values of its parameters on one or several of the open light fields:
/// what was asked for, and the points that are there.
struct Sweep {
  std::uint64_t id = 0;  ///< Never given twice.
  EstimateRequest base;
  std::vector<SweptParameter> swept;  ///< One or two.
  std::vector<SweepScene> scenes;
  bool is_saved = false;  ///< A file of the user's holds what is there.
};

/// Seconds that its points took.
[[nodiscard]] double seconds_of(const Sweep& sweep);

/// Runs a point on the centre view and judges it. `reference` is the estimate of the first point;
/// null while there is none. What the method throws is the problem of the point; throws Cancelled.
[[nodiscard]] SweepPoint run_sweep_point(const Scene& scene, const EstimateRequest& base,
                                         const ParameterSet& point, const Estimate* reference,
                                         const Progress& progress);

/// `values` with those of `point` in their place.
[[nodiscard]] ParameterSet values_at(const ParameterSet& values, const ParameterSet& point);

}  // namespace episcope
