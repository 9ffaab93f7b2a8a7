// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep/sweep.h"

#include "app/session/judge/verdict.h"
#include "engine/core/error.h"
#include "engine/evaluation/tables/parameter_search.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <new>

namespace episcope {
namespace {

std::optional<double> median_change(const DisparityView& a, const DisparityView& b) {
  std::vector<float> changes;
  for (int y = 0; y < a.disparity.height; ++y) {
    for (int x = 0; x < a.disparity.width; ++x) {
      if (!a.is_valid(y, x) || !b.is_valid(y, x)) continue;
      changes.push_back(std::abs(a.disparity.at(y, x) - b.disparity.at(y, x)));
    }
  }
  if (changes.empty()) return std::nullopt;
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return *middle;
}

void fill(const Scene& scene, const EstimateRequest& request, const Estimate* reference,
          const Progress& progress, SweepPoint& point) {
  const FinishedEstimate finished =
      run_estimator(*scene.light_field, request, progress.part(0, 0.97));
  point.estimate = finished.estimate;
  point.display_range = finished.display_range;
  point.seconds = finished.estimate->seconds;
  const ViewIndex center = scene.light_field->center();
  const Estimate& other = reference ? *reference : *finished.estimate;
  if (finished.estimate->contains(center) && other.contains(center)) {
    point.change_px =
        median_change(finished.estimate->field.view(center), other.field.view(center));
  }
  const GroundTruth& truth = *scene.truth;
  if (!truth.has_disparity() && !truth.has_layers()) return;
  Verdict verdict = judge_by_both(*finished.estimate, scene, progress);
  point.vmv2013 = std::move(verdict.vmv2013);
  point.benchmark2016 = std::move(verdict.benchmark2016);
  point.problem = std::move(verdict.problem);
}

}  // namespace

bool has_truth(const SweepScene& scene) {
  return std::ranges::any_of(scene.points, [](const SweepPoint& point) {
    return !point.vmv2013.empty() || !point.benchmark2016.empty();
  });
}

double seconds_of(const Sweep& sweep) {
  double seconds = 0;
  for (const SweepScene& scene : sweep.scenes) {
    for (const SweepPoint& point : scene.points) seconds += point.seconds;
  }
  return seconds;
}

ParameterSet values_at(const ParameterSet& values, const ParameterSet& point) {
  ParameterSet changed = values;
  for (const auto& [key, value] : point) {
    const auto found = std::ranges::find(changed, key, &ParameterSet::value_type::first);
    if (found == changed.end()) {
      changed.emplace_back(key, value);
    } else {
      found->second = value;
    }
  }
  return changed;
}

std::vector<ParameterSet> sweep_points(const std::vector<ParameterDescription>& descriptions,
                                       const ParameterSet& base,
                                       const std::vector<SweptParameter>& swept) {
  std::vector<ParameterDescription> grid;
  std::size_t count = 1;
  for (const SweptParameter& each : swept) {
    const auto known = std::ranges::find(descriptions, each.key, &ParameterDescription::key);
    if (known == descriptions.end()) throw InvalidInput("there is no parameter " + each.key);
    grid.push_back(*known);
    grid.back().searched = each.values;
    const auto present = std::ranges::find(base, each.key, &ParameterSet::value_type::first);
    if (present != base.end()) grid.back().default_value = present->second;
    count *= each.values.size();
  }
  if (count > kMaxSearchPoints) {
    throw InvalidInput(fmt::format("{} points are too many: give fewer values, for {} at most",
                                   count, kMaxSearchPoints));
  }
  return search_grid(grid);
}

SweepPoint run_sweep_point(const Scene& scene, const EstimateRequest& base,
                           const ParameterSet& point, const Estimate* reference,
                           const Progress& progress) {
  SweepPoint result;
  result.point = point;
  const EstimateRequest request{
      base.method, values_at(base.parameters, point), {.views = ViewSelection::Center}};
  try {
    fill(scene, request, reference, progress, result);
  } catch (const Error& error) {
    progress.check();
    result.problem = error.what();
  } catch (const std::bad_alloc&) {
    result.problem = "not enough memory";
  }
  return result;
}

}  // namespace episcope
