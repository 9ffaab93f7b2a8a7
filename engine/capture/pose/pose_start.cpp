// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/pose/pose_start.h"

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace episcope::capture {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr double kFlat = 0.01;
constexpr int kMostSubsets = 60;

Eigen::Vector3d place_of(const PointPair& pair) {
  return {pair.point.x, pair.point.y, pair.point.z};
}

/// The ray (x, y, 1) of a pick.
Eigen::Vector2d ray_of(const PointPair& pair, const Pinhole& pinhole) {
  return {(pair.x_px - pinhole.center_x) / pinhole.focal_px,
          (pair.y_px - pinhole.center_y) / pinhole.focal_px};
}

/// Principal axes of the points and their extents.
struct Shape {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Matrix3d axes;  ///< Columns, the longest first, right-handed.
  Eigen::Vector3d extent;
};

Shape shape_of(std::span<const PointPair> pairs) {
  Shape shape;
  for (const PointPair& pair : pairs) shape.center += place_of(pair);
  shape.center /= static_cast<double>(pairs.size());
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    const Eigen::Vector3d from = place_of(pair) - shape.center;
    scatter += from * from.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  shape.axes = solver.eigenvectors().rowwise().reverse();
  if (shape.axes.determinant() < 0) shape.axes.col(2) *= -1;
  shape.extent = solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt();
  return shape;
}

RigidPose rigid(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  RigidPose pose;
  Eigen::Map<Matrix3>(pose.rotation.data()) = rotation;
  Eigen::Map<Eigen::Vector3d>(pose.translation.data()) = translation;
  return pose;
}

/// The nearest rotation.
Eigen::Matrix3d orthogonal(const Eigen::Matrix3d& matrix) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  turn(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  return svd.matrixU() * turn * svd.matrixV().transpose();
}

Eigen::VectorXd null_vector(const Eigen::MatrixXd& matrix) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeFullV);
  return svd.matrixV().col(matrix.cols() - 1);
}

/// From H = [r1 r2 t] of the points in the axes of their plane.
std::optional<RigidPose> by_homography(std::span<const PointPair> pairs, const Shape& shape,
                                       const Pinhole& pinhole) {
  Eigen::MatrixXd rows(2 * pairs.size(), 9);
  const double scale = shape.extent[0];
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d p = shape.axes.transpose() * (place_of(pairs[i]) - shape.center) / scale;
    const Eigen::Vector2d ray = ray_of(pairs[i], pinhole);
    const Eigen::RowVector3d q(p.x(), p.y(), 1);
    const Eigen::RowVector3d none = Eigen::RowVector3d::Zero();
    rows.row(2 * i) << q, none, -ray.x() * q;
    rows.row(2 * i + 1) << none, q, -ray.y() * q;
  }
  const Eigen::VectorXd h = null_vector(rows);
  Matrix3 homography = Eigen::Map<const Matrix3>(h.data());
  homography *=
      (homography(2, 2) < 0 ? -2 : 2) / (homography.col(0).norm() + homography.col(1).norm());
  if (!homography.allFinite()) return {};
  Eigen::Matrix3d frame;
  frame << homography.col(0), homography.col(1),
      homography.col(0).head<3>().cross(homography.col(1).head<3>());
  const Eigen::Matrix3d rotation = orthogonal(frame) * shape.axes.transpose();
  return rigid(rotation, homography.col(2) * scale - rotation * shape.center);
}

std::optional<RigidPose> by_linear_transform(std::span<const PointPair> pairs, const Shape& shape,
                                             const Pinhole& pinhole) {
  Eigen::MatrixXd rows(2 * pairs.size(), 12);
  const double scale = shape.extent[0];
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Vector3d p = (place_of(pairs[i]) - shape.center) / scale;
    const Eigen::Vector2d ray = ray_of(pairs[i], pinhole);
    const Eigen::RowVector4d q(p.x(), p.y(), p.z(), 1);
    const Eigen::RowVector4d none = Eigen::RowVector4d::Zero();
    rows.row(2 * i) << q, none, -ray.x() * q;
    rows.row(2 * i + 1) << none, q, -ray.y() * q;
  }
  const Eigen::VectorXd p = null_vector(rows);
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> projection =
      Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(p.data());
  const Eigen::Matrix3d left = projection.leftCols<3>();
  const double size = std::cbrt(std::abs(left.determinant()));
  if (!(size > 0)) return {};
  projection *= (projection(2, 3) < 0 ? -1 : 1) / size;
  const Eigen::Matrix3d rotation = orthogonal(projection.leftCols<3>());
  return rigid(rotation, projection.col(3) * scale - rotation * shape.center);
}

std::optional<RigidPose> by_sqpnp(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> rays;
  for (const PointPair& pair : pairs) {
    const Eigen::Vector2d ray = ray_of(pair, pinhole);
    points.emplace_back(pair.point.x, pair.point.y, pair.point.z);
    rays.emplace_back(ray.x(), ray.y());
  }
  cv::Mat axis;
  cv::Mat shift;
  cv::Mat rotation;
  try {
    if (!cv::solvePnP(points, rays, cv::Mat::eye(3, 3, CV_64F), cv::noArray(), axis, shift, false,
                      cv::SOLVEPNP_SQPNP)) {
      return {};
    }
    cv::Rodrigues(axis, rotation);
  } catch (const cv::Exception&) {
    return {};
  }
  return rigid(Eigen::Map<const Matrix3>(rotation.ptr<double>()),
               Eigen::Map<const Eigen::Vector3d>(shift.ptr<double>()));
}

PointLayout layout_of(const Shape& shape) {
  if (shape.extent[1] < kFlat * shape.extent[0]) return PointLayout::Line;
  return shape.extent[2] < kFlat * shape.extent[0] ? PointLayout::Plane : PointLayout::Space;
}

}  // namespace

PointLayout layout_of(std::span<const PointPair> pairs) {
  return layout_of(shape_of(pairs));
}

std::optional<RigidPose> first_pose(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  const Shape shape = shape_of(pairs);
  const PointLayout layout = layout_of(shape);
  if (layout == PointLayout::Line || pairs.size() < 4) return {};
  if (layout == PointLayout::Plane) return by_homography(pairs, shape, pinhole);
  if (pairs.size() < 6) return by_sqpnp(pairs, pinhole);
  return by_linear_transform(pairs, shape, pinhole);
}

std::vector<RigidPose> first_poses(std::span<const PointPair> pairs, const Pinhole& pinhole) {
  std::vector<RigidPose> poses;
  const auto add = [&](std::span<const PointPair> of) {
    if (const auto pose = first_pose(of, pinhole)) poses.push_back(*pose);
  };
  add(pairs);
  if (pairs.size() < 5) return poses;
  std::mt19937 random(1);
  std::vector<PointPair> drawn(pairs.begin(), pairs.end());
  for (int i = 0; i < kMostSubsets; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      std::swap(drawn[k], drawn[k + random() % (drawn.size() - k)]);
    }
    add(std::span(drawn).first(4));
  }
  return poses;
}

}  // namespace episcope::capture
