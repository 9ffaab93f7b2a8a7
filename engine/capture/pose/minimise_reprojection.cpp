// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pose/minimise_reprojection.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace episcope::capture {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Jacobian = Eigen::Matrix<double, 2, 6>;

constexpr int kMostIterations = 100;
constexpr double kLeastStep = 1e-12;

struct Pose {
  Matrix3 rotation;
  Eigen::Vector3d translation;
};

Pose pose_of(const RigidPose& pose) {
  return {Eigen::Map<const Matrix3>(pose.rotation.data()),
          Eigen::Map<const Eigen::Vector3d>(pose.translation.data())};
}

RigidPose rigid(const Pose& pose) {
  RigidPose result;
  Eigen::Map<Matrix3>(result.rotation.data()) = pose.rotation;
  Eigen::Map<Eigen::Vector3d>(result.translation.data()) = pose.translation;
  return result;
}

/// exp(ω)·R, t + δ.
Pose moved(const Pose& pose, const Vector6& step) {
  const Eigen::Vector3d axis = step.head<3>();
  const double angle = axis.norm();
  Pose result = pose;
  if (angle > 0) {
    result.rotation = Eigen::AngleAxisd(angle, axis / angle).toRotationMatrix() * pose.rotation;
    result.rotation =
        Eigen::Quaterniond(Eigen::Matrix3d(result.rotation)).normalized().toRotationMatrix();
  }
  result.translation += step.tail<3>();
  return result;
}

/// Of the projection by rotation vector and translation; `turned` is R·X, `seen` R·X + t.
Jacobian jacobian_of(const Eigen::Vector3d& turned, const Eigen::Vector3d& seen, double focal) {
  Eigen::Matrix<double, 2, 3> by_place;
  const double scale = focal / seen.z();
  by_place << scale, 0, -scale * seen.x() / seen.z(), 0, scale, -scale * seen.y() / seen.z();
  Matrix3 cross;
  cross << 0, -turned.z(), turned.y(), turned.z(), 0, -turned.x(), -turned.y(), turned.x(), 0;
  Jacobian jacobian;
  jacobian << -by_place * cross, by_place;
  return jacobian;
}

struct Normal {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
};

Normal normal_equations(std::span<const PointPair> pairs, const Pose& pose, const Pinhole& pinhole,
                        double threshold) {
  Normal normal;
  const RigidPose current = rigid(pose);
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d turned =
        pose.rotation * Eigen::Vector3d(pair.point.x, pair.point.y, pair.point.z);
    const auto [rx, ry] = reprojection_residual(pair, current, pinhole);
    const Eigen::Vector2d residual(rx, ry);
    const double size = residual.norm();
    const double weight = pair.is_locked || size <= threshold ? 1 : threshold / size;
    const Jacobian j = jacobian_of(turned, turned + pose.translation, pinhole.focal_px);
    normal.matrix += weight * j.transpose() * j;
    normal.gradient += weight * j.transpose() * residual;
  }
  return normal;
}

}  // namespace

std::array<double, 2> reprojection_residual(const PointPair& pair, const RigidPose& pose,
                                            const Pinhole& pinhole) {
  const Point3 seen = pose.apply(pair.point);
  if (!(seen.z > 0)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  return {pinhole.focal_px * seen.x / seen.z + pinhole.center_x - pair.x_px,
          pinhole.focal_px * seen.y / seen.z + pinhole.center_y - pair.y_px};
}

double huber_cost(std::span<const PointPair> pairs, const RigidPose& pose, const Pinhole& pinhole,
                  double threshold_px) {
  double sum = 0;
  for (const PointPair& pair : pairs) {
    const auto [x, y] = reprojection_residual(pair, pose, pinhole);
    const double size = std::hypot(x, y);
    if (!std::isfinite(size)) return std::numeric_limits<double>::infinity();
    const bool is_square = pair.is_locked || size <= threshold_px;
    sum += is_square ? size * size / 2 : threshold_px * (size - threshold_px / 2);
  }
  return sum;
}

MinimisedPose minimise_reprojection(std::span<const PointPair> pairs, const RigidPose& start,
                                    const Pinhole& pinhole, double threshold_px) {
  MinimisedPose result{start, huber_cost(pairs, start, pinhole, threshold_px), 0, {}};
  if (!std::isfinite(result.cost)) return result;
  Pose pose = pose_of(start);
  double damping = 1e-3;
  Normal normal = normal_equations(pairs, pose, pinhole, threshold_px);
  for (; result.iterations < kMostIterations && damping < 1e12; ++result.iterations) {
    Matrix6 damped = normal.matrix;
    damped.diagonal() *= 1 + damping;
    const Vector6 step = -damped.ldlt().solve(normal.gradient);
    if (!step.allFinite()) break;
    const Pose next = moved(pose, step);
    const double cost = huber_cost(pairs, rigid(next), pinhole, threshold_px);
    const bool is_tiny = step.head<3>().norm() < kLeastStep &&
                         step.tail<3>().norm() < kLeastStep * pose.translation.norm();
    if (cost <= result.cost) {
      pose = next;
      result.cost = cost;
      damping /= 10;
      normal = normal_equations(pairs, pose, pinhole, threshold_px);
    } else {
      damping *= 10;
    }
    if (is_tiny) break;
  }
  result.pose = rigid(pose);
  const Matrix6 inverse = normal.matrix.completeOrthogonalDecomposition().pseudoInverse();
  Eigen::Map<Matrix6>(result.unit_covariance.data()) = inverse;
  return result;
}

}  // namespace episcope::capture
