// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pose/solve_pose.h"

#include "engine/capture/pose/minimise_reprojection.h"
#include "engine/capture/pose/pose_start.h"
#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::capture {
namespace {

constexpr double kHuber = 2;
constexpr double kOutlier = 3;         // px,
constexpr double kOutlierMedians = 5;  // and median residuals.
constexpr double kUsualError = 0.5;    // px, of the paper's scenes
constexpr std::size_t kStarts = 5;     // That are minimised.

/// The best of all starts.
MinimisedPose best_pose(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  struct Start {
    double cost;
    RigidPose pose;
  };
  std::vector<Start> starts;
  for (const RigidPose& pose : first_poses(pairs, pinhole)) {
    starts.push_back({huber_cost(pairs, pose, pinhole, kHuber), pose});
  }
  std::ranges::stable_sort(starts, {}, &Start::cost);
  MinimisedPose best;
  best.cost = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(kStarts, starts.size()); ++i) {
    const MinimisedPose pose = minimise_reprojection(pairs, starts[i].pose, pinhole, kHuber);
    if (pose.cost < best.cost) best = pose;
  }
  return best;
}

std::vector<double> residuals_of(std::span<const PointPair> pairs, const RigidPose& pose,
                                 const Pinhole& pinhole) {
  std::vector<double> sizes;
  for (const PointPair& pair : pairs) {
    const auto [x, y] = reprojection_residual(pair, pose, pinhole);
    sizes.push_back(std::hypot(x, y));
  }
  return sizes;
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<long>(values.size() / 2));
  return values[values.size() / 2];
}

std::vector<PairResidual> judged(std::span<const PointPair> pairs, const RigidPose& pose,
                                 const Pinhole& pinhole) {
  const std::vector<double> sizes = residuals_of(pairs, pose, pinhole);
  const double limit = std::max(kOutlier, kOutlierMedians * median(sizes));
  std::vector<PairResidual> judgements;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    judgements.push_back({sizes[i], !pairs[i].is_locked && sizes[i] > limit});
  }
  const auto right = std::ranges::count(judgements, false, &PairResidual::is_outlier);
  if (right < 4) {
    for (PairResidual& each : judgements) each.is_outlier = false;
  }
  return judgements;
}

std::vector<PointPair> kept(std::span<const PointPair> pairs,
                            std::span<const PairResidual> judgements) {
  std::vector<PointPair> rest;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!judgements[i].is_outlier) rest.push_back(pairs[i]);
  }
  return rest;
}

/// Refuses pairs that fit the mirror image of the mesh far better.
void refuse_mirrored(std::span<const PointPair> pairs, const Pinhole& pinhole, double cost) {
  const double tolerance = kUsualError * kUsualError * static_cast<double>(pairs.size());
  if (pairs.size() < 6 || cost <= tolerance || layout_of(pairs) != PointLayout::Space) return;
  std::vector<PointPair> mirrored(pairs.begin(), pairs.end());
  for (PointPair& pair : mirrored) pair.point.z = -pair.point.z;
  const double other = best_pose(mirrored, pinhole).cost;
  if (!(other < cost / 10)) return;
  throw InvalidInput(
      fmt::format("the mesh is a mirror image of what the camera sees (its axes are left-handed): "
                  "mirrored, the pairs fit {:.0f} times better; negate its Z and pick again",
                  std::sqrt(cost / std::max(other, 1e-12))));
}

/// Least depth error along the optical axis (paper, section 3.2.1).
double delta_tz(std::span<const PointPair> pairs, const RigidPose& pose, const Pinhole& pinhole,
                double error_px, double& depth) {
  double least = std::numeric_limits<double>::infinity();
  for (const PointPair& pair : pairs) {
    const double z = pose.apply(pair.point).z;
    const double off =
        std::max(std::abs(pair.x_px - pinhole.center_x), std::abs(pair.y_px - pinhole.center_y));
    const double delta = z * error_px / off;
    if (delta < least) depth = z;
    least = std::min(least, delta);
  }
  return least;
}

void set_errors(std::span<const PointPair> pairs, const MinimisedPose& pose,
                const CameraGrid& camera, SolvedPose& solved) {
  const std::vector<double> sizes = residuals_of(pairs, pose.pose, *camera.pinhole);
  double sum = 0;
  double squares = 0;
  for (const double size : sizes) {
    sum += size;
    squares += size * size;
  }
  solved.reprojection_error_px = sum / static_cast<double>(sizes.size());
  const double freedom = 2 * static_cast<double>(sizes.size()) - 6;
  const double variance = sizes.size() > 4 ? squares / freedom : kUsualError * kUsualError;
  std::ranges::transform(pose.unit_covariance, solved.covariance.begin(),
                         [variance](double value) { return variance * value; });
  double depth = 0;
  solved.delta_tz =
      delta_tz(pairs, pose.pose, *camera.pinhole, solved.reprojection_error_px, depth);
  solved.delta_tz_px =
      camera.is_known() ? camera.baseline * camera.focal_length * solved.delta_tz / (depth * depth)
                        : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

SolvedPose solve_pose(std::span<const PointPair> pairs, const CameraGrid& camera) {
  if (!camera.pinhole) throw InvalidInput("the pinhole of the camera is not known");
  if (pairs.size() < 4) {
    throw InvalidInput(
        fmt::format("a pose needs 4 pairs, and there are {}; pick more, best 10", pairs.size()));
  }
  if (layout_of(pairs) == PointLayout::Line) {
    throw InvalidInput(
        "the points of the pairs lie on one line, which leaves the pose open; pick "
        "points beside it");
  }
  const Pinhole& pinhole = *camera.pinhole;
  MinimisedPose pose = best_pose(pairs, pinhole);
  if (!std::isfinite(pose.cost)) {
    throw InvalidInput(
        "no pose in front of the camera fits these pairs; check that each names the "
        "same point in the view and on the mesh");
  }
  SolvedPose solved;
  solved.pairs = judged(pairs, pose.pose, pinhole);
  const std::vector<PointPair> rest = kept(pairs, solved.pairs);
  refuse_mirrored(pairs, pinhole, pose.cost);
  if (rest.size() < pairs.size()) {
    pose = minimise_reprojection(rest, pose.pose, pinhole, kHuber);
    const std::vector<double> sizes = residuals_of(pairs, pose.pose, pinhole);
    for (std::size_t i = 0; i < sizes.size(); ++i) solved.pairs[i].residual_px = sizes[i];
  }
  solved.pose = pose.pose;
  set_errors(rest, pose, camera, solved);
  return solved;
}

}  // namespace episcope::capture
