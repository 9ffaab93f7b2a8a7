// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/cloud_distance.h"

#include "engine/core/error.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/point_cloud.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace episcope {
namespace {

namespace geometry = boost::geometry;

using Point = geometry::model::point<float, 3, geometry::cs::cartesian>;
using Tree = geometry::index::rtree<Point, geometry::index::rstar<16>>;

/// Rows of a search tree: it is built in 20 ms, so that a stop request is heard in between.
constexpr int kBandRows = 32;
/// Where reference and estimate have the same units, z is anyway not a matter of taste.
constexpr double kNoStretch = 1;

std::optional<Point> point_at(const DisparityView& view, const BackProjection& project, int y,
                              int x) {
  if (!view.is_valid(y, x)) return std::nullopt;
  const auto place = project(y, x, view.disparity.at(y, x));
  if (!std::isfinite(place[2])) return std::nullopt;
  return Point(float(place[0]), float(place[1]), float(place[2]));
}

std::vector<Tree> trees_of(const DisparityView& view, const BackProjection& project,
                           const Progress& progress) {
  const int height = view.disparity.height;
  std::vector<Tree> trees((height + kBandRows - 1) / kBandRows);
  parallel_for(static_cast<int>(trees.size()), progress, [&](int band) {
    std::vector<Point> points;
    const int end = std::min((band + 1) * kBandRows, height);
    for (int y = band * kBandRows; y < end; ++y) {
      for (int x = 0; x < view.disparity.width; ++x) {
        if (const auto point = point_at(view, project, y, x)) points.push_back(*point);
      }
    }
    trees[band] = Tree(points);
  });
  std::erase_if(trees, [](const Tree& tree) { return tree.empty(); });
  return trees;
}

/// Squared distance to the nearest point of all trees; the search begins at tree `first`.
class Nearest {
 public:
  explicit Nearest(const std::vector<Tree>& trees) : trees_(trees) {
    for (const Tree& tree : trees) boxes_.push_back(tree.bounds());
  }

  [[nodiscard]] double squared(const Point& point, std::size_t first) const {
    double best = in_tree(point, first);
    for (std::size_t i = 0; i < trees_.size(); ++i) {
      if (i == first || geometry::comparable_distance(point, boxes_[i]) >= best) continue;
      best = std::min(best, in_tree(point, i));
    }
    return best;
  }

 private:
  [[nodiscard]] double in_tree(const Point& point, std::size_t tree) const {
    Point found;
    trees_[tree].query(geometry::index::nearest(point, 1), &found);
    return geometry::comparable_distance(point, found);
  }

  const std::vector<Tree>& trees_;
  std::vector<Tree::bounds_type> boxes_;
};

CloudDistance summarised(Image<float> distance) {
  CloudDistance result;
  std::vector<float> values;
  std::copy_if(distance.data(), distance.data() + distance.size(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  if (values.empty()) {
    throw InvalidInput("the estimate has no pixel with a depth, so it has no distance to another");
  }
  double sum = 0;
  for (const float value : values) sum += value;
  result.distance = std::move(distance);
  result.points = values.size();
  result.mean = sum / static_cast<double>(values.size());
  result.median = quantile(values, 0.5);
  result.percentile95 = quantile(values, 0.95);
  return result;
}

void check(const DisparityView& estimate, const DisparityView& reference,
           const CameraGrid& camera) {
  if (!camera.is_known()) {
    throw InvalidInput(
        "the camera of this light field is not known, so distances in space cannot be measured");
  }
  if (estimate.disparity.height != reference.disparity.height ||
      estimate.disparity.width != reference.disparity.width) {
    throw InvalidInput("point clouds can be compared only if their maps have the same size");
  }
}

}  // namespace

CloudDistance cloud_distance(const DisparityView& estimate, const DisparityView& reference,
                             const CameraGrid& camera, const Progress& progress) {
  check(estimate, reference, camera);
  const int height = estimate.disparity.height;
  const int width = estimate.disparity.width;
  const BackProjection project(camera, height, width, kNoStretch);
  const std::vector<Tree> trees = trees_of(reference, project, progress.part(0, 0.3));
  if (trees.empty()) {
    throw InvalidInput("the reference has no pixel with a depth, so nothing has a distance to it");
  }
  const Nearest nearest(trees);
  Image<float> distance(height, width, 1, std::numeric_limits<float>::quiet_NaN());
  parallel_for(height, progress.part(0.3, 1), [&](int y) {
    const std::size_t first = trees.size() * y / height;
    for (int x = 0; x < width; ++x) {
      const auto point = point_at(estimate, project, y, x);
      if (point) distance.at(y, x) = static_cast<float>(std::sqrt(nearest.squared(*point, first)));
    }
  });
  return summarised(std::move(distance));
}

}  // namespace episcope
