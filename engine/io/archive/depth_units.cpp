// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/depth_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::io {
namespace {

constexpr double kPlausibleDisparity = 20;

struct Reading {
  CameraGrid camera;
  std::string name;
  bool has_width = true;  ///< dH is taken to hold the factor xRes.
  Interval disparity;
  double error = std::numeric_limits<double>::infinity();

  [[nodiscard]] bool is_plausible() const {
    return std::max(std::abs(disparity.min), std::abs(disparity.max)) < kPlausibleDisparity;
  }
};

std::string number(double value) {
  return fmt::format("{:.4g}", value);
}

/// Depth where d = 0, infinite for a shift of 0.
double zero_depth(const CameraGrid& camera) {
  return camera.shift > 0 ? camera.baseline * camera.focal_length / camera.shift
                          : std::numeric_limits<double>::infinity();
}

bool holds_zero_depth(const Reading& reading, const Interval& depth) {
  const double zero = zero_depth(reading.camera);
  const double margin = 0.1 * depth.length() + 1e-9;
  return zero > depth.min - margin && zero < depth.max + margin;
}

std::vector<Reading> readings(const DepthFacts& facts) {
  const auto scaled = [&](double baseline, double shift) {
    CameraGrid camera = facts.stored;
    camera.baseline *= baseline;
    camera.shift *= shift;
    return camera;
  };
  const double width = facts.width;
  std::vector<Reading> all{{scaled(1, 1), "dH and shift as stored", true, {}},
                           {scaled(width, width), "dH and shift times xRes", false, {}},
                           {scaled(width, 1), "dH times xRes, shift as stored", false, {}}};
  for (Reading& one : all) {
    one.disparity = {one.camera.disparity_from_depth(facts.depth.max),
                     one.camera.disparity_from_depth(facts.depth.min)};
  }
  return all;
}

/// Keeps the readings that satisfy a claim, or all if none does.
template <class Claim>
void prefer(std::vector<Reading>& readings, const Claim& claim) {
  if (std::any_of(readings.begin(), readings.end(), claim)) {
    std::erase_if(readings, [&](const Reading& one) { return !claim(one); });
  }
}

const Reading& best_by_warping(std::vector<Reading>& readings,
                               const std::function<double(const CameraGrid&)>& warp_error) {
  if (readings.size() == 1) return readings.front();
  for (Reading& one : readings) one.error = warp_error(one.camera);
  const Reading* best = &readings.front();
  for (const Reading& one : readings) {
    if (one.error < 0.97 * best->error) best = &one;
  }
  return *best;
}

}  // namespace

UnitsFinding find_units(const DepthFacts& facts, Units choice,
                        const std::function<double(const CameraGrid&)>& warp_error) {
  std::vector<Reading> all = readings(facts);
  if (choice != Units::Auto) {
    std::erase_if(
        all, [&](const Reading& one) { return one.has_width != (choice == Units::WithWidth); });
  }
  prefer(all, [](const Reading& one) { return one.is_plausible(); });
  prefer(all, [&](const Reading& one) { return holds_zero_depth(one, facts.depth); });
  const Reading& taken = best_by_warping(all, warp_error);

  UnitsFinding finding{taken.camera, {}, {}, {}};
  finding.text = "d = dH·focalLength/Z − shift with " + taken.name + ": " +
                 number(taken.disparity.min) + " … " + number(taken.disparity.max) +
                 " px for depth " + number(facts.depth.min) + " … " + number(facts.depth.max);
  if (std::isfinite(taken.error)) {
    finding.check =
        "this warps the views onto each other best (" + number(taken.error) + " grey levels)";
  }
  if (!taken.is_plausible()) {
    finding.warnings.push_back(
        "The depth gives disparities of " + number(taken.disparity.min) + " … " +
        number(taken.disparity.max) +
        " px per view step, which is implausible; check dH, focalLength and shift of the file.");
  }
  return finding;
}

void settle_zero_depth(CameraGrid& camera, ConventionReport& report) {
  if (!camera.is_known() || !camera.cam_distance) return;
  const double zero = zero_depth(camera);
  if (std::abs(zero - *camera.cam_distance) < 0.01 * *camera.cam_distance) return;
  const std::string by_shift =
      std::isfinite(zero) ? "is zero at depth " + number(zero) : "is zero at no finite depth";
  report.warnings.push_back("According to dH, focalLength and shift, disparity " + by_shift +
                            ", but camDistance says " + number(*camera.cam_distance) +
                            "; camDistance is ignored; check these attributes of the file.");
  camera.cam_distance.reset();
  if (std::isfinite(zero)) camera.cam_distance = zero;
}

}  // namespace episcope::io
