// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/ranges.h"

#include "engine/disparity/disparity_range.h"
#include "tests/accuracy/means.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

namespace episcope::accuracy {
namespace {

double share_within(const Scene& scene, Interval range) {
  const DisparityView truth = scene.truth->field.view(scene.light_field->center());
  std::size_t valid = 0, within = 0;
  for (int y = 0; y < truth.disparity.height; ++y) {
    for (int x = 0; x < truth.disparity.width; ++x) {
      if (!truth.is_valid(y, x)) continue;
      const double disparity = truth.disparity.at(y, x);
      ++valid;
      within += disparity >= range.min && disparity <= range.max ? 1 : 0;
    }
  }
  return static_cast<double>(within) / static_cast<double>(std::max<std::size_t>(valid, 1));
}

}  // namespace

FoundRange find_range(const Scene& scene, const Progress& progress) {
  FoundRange range;
  const auto begin = std::chrono::steady_clock::now();
  range.found = find_disparity_range(*scene.light_field, progress);
  range.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  range.truth = true_range(scene);
  range.covered = share_within(scene, range.found);
  return range;
}

std::string ranges_head() {
  return "| set | scene | range found px | truth px | width found | of at most | covered % | "
         "seconds | fails |\n|---|---|---|---|---:|---:|---:|---:|---|\n";
}

std::string ranges_row(const FoundRange& r) {
  return fmt::format(
      "| {} | {} | {:.2f} to {:.2f} | {:.2f} to {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | "
      "{}{} |\n",
      r.group, r.scene, r.found.min, r.found.max, r.truth.min, r.truth.max, r.found.length(),
      r.widest(), 100 * r.covered, r.seconds, r.is_narrow() ? "" : "wide ",
      r.covers() ? "" : "short");
}

std::string ranges_summary(const std::vector<FoundRange>& ranges) {
  const auto narrow = std::ranges::count_if(ranges, &FoundRange::is_narrow);
  const auto covering = std::ranges::count_if(ranges, &FoundRange::covers);
  return fmt::format(
      "Of {} ranges found {} are at most 1.25 times as wide as the truth and 0.3 px, and {} hold "
      "99.5 % of the pixels.\n",
      ranges.size(), narrow, covering);
}

double TwiceRange::ratio() const {
  return std::max(twice.mse_100, kLeastMse) / std::max(once.mse_100, kLeastMse);
}

TwiceRange measure_twice(const std::string& name, const Scene& scene, const Estimator& estimator,
                         const ParameterSet& values, ViewSelection views,
                         const Progress& progress) {
  const Interval truth = true_range(scene);
  const auto with_range = [&](double beyond) {
    ParameterSet ranged = values;
    ranged.emplace_back("range", Interval{truth.min - beyond, truth.max + beyond});
    return measure(name, scene, estimator, ranged, views, progress);
  };
  return {with_range(0), with_range(truth.length() / 2)};
}

std::string twice_head() {
  return "| set | scene | method | MSE×100, true range | twice the range | ratio |\n"
         "|---|---|---|---:|---:|---:|\n";
}

std::string twice_row(const TwiceRange& errors) {
  const Measurement& once = errors.once;
  return fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.2f} |\n", once.group, once.scene,
                     once.method, once.mse_100, errors.twice.mse_100, errors.ratio());
}

std::string twice_summary(const std::vector<TwiceRange>& errors) {
  std::map<std::string, std::vector<double>> ratios;
  for (const TwiceRange& each : errors) ratios[each.once.method].push_back(each.ratio());
  std::string table =
      "| method | scenes | ratio, geometric mean | largest | at most 1.15 |\n"
      "|---|---:|---:|---:|---:|\n";
  for (const auto& [method, all] : ratios) {
    double logs = 0;
    for (const double ratio : all) logs += std::log(ratio);
    const auto passing = std::ranges::count_if(all, [](double ratio) { return ratio <= 1.15; });
    table += fmt::format("| {} | {} | {:.2f} | {:.2f} | {} |\n", method, all.size(),
                         std::exp(logs / static_cast<double>(all.size())),
                         *std::ranges::max_element(all), passing);
  }
  return table;
}

}  // namespace episcope::accuracy
