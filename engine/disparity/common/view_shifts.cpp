// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/view_shifts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

// Shifts this near to whole pixels are taken as whole.
constexpr double kWhole = 1e-5;

AxisShift make_shift(double shift, int extent, Interpolation interpolation) {
  AxisShift result;
  const double whole = std::floor(shift + kWhole);
  const double t = shift - whole;
  result.origin = static_cast<int>(whole);
  result.nearest = result.origin + (t > 0.5 ? 1 : 0);
  result.first = std::clamp(static_cast<int>(std::ceil(-shift - kWhole)), 0, extent);
  result.last =
      std::clamp(static_cast<int>(std::floor(extent - 1 - shift + kWhole)) + 1, 0, extent);
  if (std::abs(t) <= kWhole) return result;
  if (interpolation == Interpolation::Bilinear) {
    result.taps = 2;
    result.weights = {static_cast<float>(1 - t), static_cast<float>(t)};
    return result;
  }
  // Catmull-Rom: through the samples, exact for parabolas.
  result.taps = 4;
  result.origin -= 1;
  result.weights = {static_cast<float>(t * (-0.5 + t * (1 - 0.5 * t))),
                    static_cast<float>(1 + t * t * (-2.5 + 1.5 * t)),
                    static_cast<float>(t * (0.5 + t * (2 - 1.5 * t))),
                    static_cast<float>(t * t * (-0.5 + 0.5 * t))};
  return result;
}

}  // namespace

std::vector<double> regular_ways(int places, int reference) {
  std::vector<double> ways(places);
  std::iota(ways.begin(), ways.end(), -reference);
  return ways;
}

std::vector<double> stated_ways(const std::vector<ViewPlace>& places, std::size_t reference,
                                double ViewPlace::*axis) {
  std::vector<double> ways;
  ways.reserve(places.size());
  for (const ViewPlace& place : places) ways.push_back(place.*axis - places[reference].*axis);
  return ways;
}

std::vector<AxisShift> make_shifts(const std::vector<double>& ways, int extent,
                                   Interpolation interpolation, const std::vector<float>& labels) {
  std::vector<AxisShift> shifts;
  for (const double way : ways) {
    for (const float label : labels) {
      // u and v grow against the motion of points.
      const double shift = -label * way;
      shifts.push_back(make_shift(shift, extent, interpolation));
    }
  }
  return shifts;
}

std::vector<float> count_seen(const std::vector<AxisShift>& shifts, int labels, int extent) {
  std::vector<float> seen(static_cast<std::size_t>(labels) * extent, 0.0F);
  // How many more views see a pixel than the one before it, and then their sums.
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (shifts[i].first >= shifts[i].last) continue;
    float* row = seen.data() + i % labels * extent;
    row[shifts[i].first] += 1;
    if (shifts[i].last < extent) row[shifts[i].last] -= 1;
  }
  for (int label = 0; label < labels; ++label) {
    float* row = seen.data() + static_cast<std::size_t>(label) * extent;
    std::partial_sum(row, row + extent, row);
  }
  return seen;
}

}  // namespace episcope
