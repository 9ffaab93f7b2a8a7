// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/benchmark_metrics.h"

#include "engine/core/error.h"
#include "engine/evaluation/metrics/masked_metrics.h"

#include <algorithm>
#include <iterator>

namespace episcope {
namespace {

void append(Metrics& metrics, const Metrics& more, const char* suffix = "") {
  for (const auto& [key, value] : more) metrics.emplace_back(key + suffix, value);
}

bool has_region(const RegionInput& input, const std::string& name) {
  if (input.regions.contains(name)) return true;
  if (!input.options.high_res) return false;
  return std::ranges::count(input.options.high_res->regions(), name) > 0;
}

bool has_any(const RegionInput& input, std::initializer_list<const char*> names) {
  return std::any_of(names.begin(), names.end(),
                     [&](const char* name) { return has_region(input, name); });
}

/// Whether the official tool scores all pixels of the scene in high resolution.
bool is_scored_high(StratifiedScene scene) {
  return scene == StratifiedScene::Backgammon || scene == StratifiedScene::Dots ||
         scene == StratifiedScene::Stripes;
}

/// Adds the official numbers, and why some are missing.
void append_high_res(const RegionInput& input, StratifiedScene scene, BenchmarkMetrics& metrics) {
  const HighResTruth* high_res = input.options.high_res;
  if (!high_res) return;
  const std::vector<std::string> names = high_res->regions();
  if (names.empty() && !is_scored_high(scene)) return;
  try {
    const Image<float> truth = high_res->read_disparity();
    const ResolvedErrors errors(input.estimate, truth.view(), kHighResScale, input.options);
    constexpr int border = kBenchmarkBorder * kHighResScale;
    if (is_scored_high(scene)) append(metrics.general, errors.general(border));
    const RegionLookup region = [&](const std::string& name) -> RegionMask {
      if (std::ranges::count(names, name) == 0) return nullptr;
      return std::make_shared<const Image<std::uint8_t>>(high_res->read_region(name));
    };
    append(metrics.masked, masked_metrics(errors, border, scene, region, metrics.notes));
  } catch (const Error& error) {
    metrics.notes.push_back(std::string("scores in high resolution are left out: ") + error.what());
  }
}

void append_low_res(const RegionInput& input, StratifiedScene scene, BenchmarkMetrics& metrics) {
  const Image<float> truth = marked(input.truth);
  const ResolvedErrors errors(input.estimate, truth.view(), 1, input.options);
  append(metrics.general, errors.general(kBenchmarkBorder),
         is_scored_high(scene) ? kLowResSuffix : "");
  const RegionLookup region = [&](const std::string& name) -> RegionMask {
    const auto found = input.regions.find(name);
    if (found == input.regions.end()) return nullptr;
    return {RegionMask(), &found->second};  // borrowed
  };
  append(metrics.masked, masked_metrics(errors, kBenchmarkBorder, scene, region, metrics.notes),
         kLowResSuffix);
}

}  // namespace

StratifiedScene scene_of(const RegionInput& input) {
  if (input.options.stratified != StratifiedScene::None) return input.options.stratified;
  if (has_any(input, {"foreground_fattening", "foreground_thinning"})) {
    return StratifiedScene::Backgammon;
  }
  if (has_any(input, {"dots_by_size"})) return StratifiedScene::Dots;
  if (has_any(input, {"pyramids", "sphere_in", "sphere_out"})) return StratifiedScene::Pyramids;
  if (has_any(input, {"low_texture", "high_contrast", "low_contrast"})) {
    return StratifiedScene::Stripes;
  }
  return StratifiedScene::None;
}

BenchmarkMetrics benchmark_metrics(const RegionInput& input) {
  const StratifiedScene scene = scene_of(input);
  BenchmarkMetrics metrics;
  append_high_res(input, scene, metrics);
  append_low_res(input, scene, metrics);
  return metrics;
}

}  // namespace episcope
