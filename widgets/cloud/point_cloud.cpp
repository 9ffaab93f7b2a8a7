// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/cloud/point_cloud.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace episcope {
namespace {

/// Without a camera, one px of disparity is drawn as this part of the larger image side.
constexpr double kDisparityReach = 0.05;
/// Smaller focal lengths are relative to the image width (eq. 2), larger ones in px: 50 image
/// widths would be a view of one degree, 50 px one of more than 150.
constexpr double kRelativeFocalLength = 50;

class Projector {
 public:
  Projector(const CameraGrid& camera, int height, int width)
      : camera_(camera),
        middle_x_((width - 1) / 2.0),
        middle_y_((height - 1) / 2.0),
        reach_(kDisparityReach * std::max(width, height)),
        focal_px_(camera.focal_length < kRelativeFocalLength ? camera.focal_length * width
                                                             : camera.focal_length) {}

  /// NaN if the disparity lies behind infinity.
  [[nodiscard]] std::array<float, 3> operator()(int y, int x, double disparity_px) const {
    const double right = x - middle_x_;
    const double up = middle_y_ - y;
    if (!camera_.is_known()) {
      return {float(right), float(up), float(disparity_px * reach_)};
    }
    const double depth = camera_.depth_from_disparity(disparity_px);
    return {float(right * depth / focal_px_), float(up * depth / focal_px_), float(-depth)};
  }

 private:
  CameraGrid camera_;
  double middle_x_;
  double middle_y_;
  double reach_;
  double focal_px_;
};

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
                            ImageView<const std::uint8_t> rgba, int step) {
  const auto& map = view.disparity;
  if (step < 1)
    throw InvalidInput("a point cloud needs a step of 1 or more, not " + std::to_string(step));
  if (rgba.height != map.height || rgba.width != map.width || rgba.channels != 4) {
    throw InvalidInput("the colours of a point cloud are " + std::to_string(rgba.width) + "×" +
                       std::to_string(rgba.height) + " pixels, but its map is " +
                       std::to_string(map.width) + "×" + std::to_string(map.height));
  }
  PointCloud cloud;
  cloud.is_metric = camera.is_known();
  const Projector project(camera, map.height, map.width);
  for (int y = 0; y < map.height; y += step) {
    for (int x = 0; x < map.width; x += step) {
      if (!view.is_valid(y, x)) continue;
      const auto position = project(y, x, map.at(y, x));
      if (!std::isfinite(position[2])) continue;
      cloud.positions.push_back(position);
      cloud.colors.push_back({rgba.at(y, x, 0), rgba.at(y, x, 1), rgba.at(y, x, 2)});
      cloud.pixels.push_back({y, x});
    }
  }
  return cloud;
}

}  // namespace episcope
