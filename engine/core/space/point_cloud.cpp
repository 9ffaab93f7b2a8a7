// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/space/point_cloud.h"

#include "engine/core/error.h"
#include "engine/core/space/back_projection.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace episcope {
namespace {

/// Without a camera, one px of disparity is drawn as this part of the larger image side.
constexpr double kDisparityReach = 0.05;

void check(const ImageView<const float>& map, const ImageView<const std::uint8_t>& rgba, int step) {
  if (step < 1)
    throw InvalidInput("a point cloud needs a step of 1 or more, not " + std::to_string(step));
  if (rgba.height != map.height || rgba.width != map.width || rgba.channels != 4) {
    throw InvalidInput("the colours of a point cloud are " + std::to_string(rgba.width) + "×" +
                       std::to_string(rgba.height) + " pixels, but its map is " +
                       std::to_string(map.width) + "×" + std::to_string(map.height));
  }
}

}  // namespace

std::array<double, 6> robust_bounds(const PointCloud& cloud) {
  constexpr std::size_t kSamples = 20'000;
  constexpr double kBeyond = 0.005;
  std::array<double, 6> box{};
  if (cloud.positions.empty()) return box;
  const std::size_t stride = cloud.positions.size() / kSamples + 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float> values;
    for (std::size_t i = 0; i < cloud.positions.size(); i += stride) {
      values.push_back(cloud.positions[i][axis]);
    }
    const auto low = static_cast<std::ptrdiff_t>(kBeyond * values.size());
    const auto high = static_cast<std::ptrdiff_t>(values.size()) - 1 - low;
    std::nth_element(values.begin(), values.begin() + low, values.end());
    box[2 * axis] = values[low];
    std::nth_element(values.begin(), values.begin() + high, values.end());
    box[2 * axis + 1] = values[high];
  }
  return box;
}

PointCloud make_point_cloud(const DisparityView& view, const CameraGrid& camera,
                            ImageView<const std::uint8_t> rgba, const CloudSampling& sampling) {
  const auto& map = view.disparity;
  const int step = sampling.step;
  check(map, rgba, step);
  PointCloud cloud;
  const BackProjection project(
      camera, map.height, map.width,
      sampling.z_per_px.value_or(kDisparityReach * std::max(map.width, map.height)));
  cloud.is_metric = project.is_metric();
  for (int y = 0; y < map.height; y += step) {
    for (int x = 0; x < map.width; x += step) {
      if (!view.is_valid(y, x)) continue;
      const auto place = project(y, x, map.at(y, x));
      if (!std::isfinite(place[2])) continue;
      cloud.positions.push_back({float(place[0]), float(place[1]), float(place[2])});
      cloud.colors.push_back({rgba.at(y, x, 0), rgba.at(y, x, 1), rgba.at(y, x, 2)});
      cloud.pixels.push_back({y, x});
    }
  }
  return cloud;
}

}  // namespace episcope
