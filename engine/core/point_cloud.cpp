// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/point_cloud.h"

#include "engine/core/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace episcope {
namespace {

/// Smaller focal lengths are relative to the image width (eq. 2), larger ones in px: 50 image
/// widths would be a view of one degree, 50 px one of more than 150.
constexpr double kRelativeFocalLength = 50;

Pinhole pinhole_of(const CameraGrid& camera, int height, int width) {
  if (camera.pinhole) return *camera.pinhole;
  const double focal_px = camera.focal_length < kRelativeFocalLength ? camera.focal_length * width
                                                                     : camera.focal_length;
  return {focal_px, (width - 1) / 2.0, (height - 1) / 2.0};
}

/// Without a camera, one px of disparity is drawn as this part of the larger image side.
constexpr double kDisparityReach = 0.05;

void check(const ImageView<const float>& map, const ImageView<const std::uint8_t>& rgba, int step) {
  if (step < 1)
    throw InvalidInput("a point cloud needs a step of 1 or more, not " + std::to_string(step));
  if (rgba.height != map.height || rgba.width != map.width || rgba.channels != 4) {
    throw InvalidInput("the colors of a point cloud are " + std::to_string(rgba.width) + "×" +
                       std::to_string(rgba.height) + " pixels, but its map is " +
                       std::to_string(map.width) + "×" + std::to_string(map.height));
  }
}

constexpr std::int32_t kMissing = -1;

/// A point as a corner of a cell: its place in the cloud and its disparity.
struct Corner {
  std::int32_t point;
  float disparity_px;
};

/// Which point is where, `[y / step][x / step]`.
Image<std::int32_t> points_by_place(const PointCloud& cloud, const DisparityView& view, int step) {
  const auto rows = [step](int pixels) { return (pixels + step - 1) / step; };
  Image<std::int32_t> points(rows(view.disparity.height), rows(view.disparity.width), 1, kMissing);
  for (std::size_t i = 0; i < cloud.pixels.size(); ++i) {
    points.at(cloud.pixels[i].y / step, cloud.pixels[i].x / step) = static_cast<std::int32_t>(i);
  }
  return points;
}

class Joiner {
 public:
  Joiner(PointCloud& cloud, double most_px) : cloud_(cloud), most_px_(most_px) {}

  /// Corners of a cell, counter-clockwise as the viewer sees them.
  void join(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    const bool along_ac =
        b.point == kMissing || d.point == kMissing ||
        (a.point != kMissing && c.point != kMissing &&
         std::abs(a.disparity_px - c.disparity_px) <= std::abs(b.disparity_px - d.disparity_px));
    if (along_ac) {
      add(a, b, c);
      add(a, c, d);
    } else {
      add(a, b, d);
      add(b, c, d);
    }
  }

 private:
  void add(const Corner& a, const Corner& b, const Corner& c) {
    if (std::min({a.point, b.point, c.point}) == kMissing) return;
    const auto [low, high] = std::minmax({a.disparity_px, b.disparity_px, c.disparity_px});
    if (high - low > most_px_) return;
    cloud_.triangles.push_back({static_cast<std::uint32_t>(a.point),
                                static_cast<std::uint32_t>(b.point),
                                static_cast<std::uint32_t>(c.point)});
  }

  PointCloud& cloud_;
  double most_px_;
};

}  // namespace

BackProjection::BackProjection(const CameraGrid& camera, int height, int width, double z_per_px)
    : camera_(camera), is_metric_(camera.is_known()), z_per_px_(z_per_px) {
  const Pinhole pinhole = pinhole_of(camera, height, width);
  focal_px_ = pinhole.focal_px;
  center_x_ = pinhole.center_x;
  center_y_ = pinhole.center_y;
}

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

void join_to_surface(PointCloud& cloud, const DisparityView& view, int step, double jump_px) {
  if (!(jump_px > 0)) throw InvalidInput("a surface needs a positive jump to be cut at, in px");
  const Image<std::int32_t> points = points_by_place(cloud, view, step);
  const auto corner = [&](int row, int column) -> Corner {
    const std::int32_t point = points.at(row, column);
    if (point == kMissing) return {kMissing, 0};
    const PixelIndex pixel = cloud.pixels[static_cast<std::size_t>(point)];
    return {point, view.disparity.at(pixel.y, pixel.x)};
  };
  cloud.triangles.clear();
  cloud.triangles.reserve(2 * cloud.pixels.size());
  Joiner joiner(cloud, jump_px * step);
  for (int row = 0; row + 1 < points.height(); ++row) {
    for (int column = 0; column + 1 < points.width(); ++column) {
      joiner.join(corner(row, column), corner(row + 1, column), corner(row + 1, column + 1),
                  corner(row, column + 1));
    }
  }
}

}  // namespace episcope
