// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify/alignment.h"

#include "engine/core/error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace episcope::capture {
namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
using Vector2 = Eigen::Vector2d;

constexpr int kRounds = 6;
constexpr int kSweeps = 12;
constexpr double kHuber = 0.3;  // px
constexpr double kOutlierMedians = 6;
constexpr double kTiltPrior = 0.02;  // radian: rotations out of the plane are hardly seen
constexpr double kNoise = 0.05;      // px, of matches
constexpr double kWorstFit = 3;      // px

struct Observation {
  int view;
  int point;
  Vector2 step;  // (u − uc, v − vc)
  Vector2 ray;
  double weight = 1;
};

Matrix3 rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Matrix3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

Vector2 turned(const Matrix3& rotation, const Vector2& ray) {
  const Eigen::Vector3d r = rotation * Eigen::Vector3d(ray.x(), ray.y(), 1);
  return {r.x() / r.z(), r.y() / r.z()};
}

/// Displacements = −parallax·step + offset of the view: solved for both by turns, for one rotation.
class Model {
 public:
  Model(const ViewMatches& matches, const LensCamera& camera)
      : focal_((camera.focal_x + camera.focal_y) / 2),
        parallax_(matches.points.size(), 0.0),
        offsets_(matches.found.size(), Vector2::Zero()) {
    for (const PlanePoint& point : matches.points) {
      const PlanePoint ray = ray_of_pixel(camera, point);
      centers_.emplace_back(ray.x, ray.y);
    }
    const ViewIndex middle = matches.grid.center();
    for (int view = 0; view < matches.grid.count(); ++view) {
      const ViewIndex index = matches.grid.view_at(view);
      const Vector2 step(index.u - middle.u, index.v - middle.v);
      steps_.push_back(step);
      if (index == middle) continue;
      for (std::size_t i = 0; i < matches.points.size(); ++i) {
        const auto& match = matches.found[view][i];
        if (!match) continue;
        const PlanePoint ray = ray_of_pixel(camera, match->place);
        observations_.push_back({view, static_cast<int>(i), step, {ray.x, ray.y}});
      }
    }
  }

  [[nodiscard]] double focal() const { return focal_; }
  [[nodiscard]] const std::vector<double>& parallax() const { return parallax_; }
  [[nodiscard]] const std::vector<Observation>& observations() const { return observations_; }

  [[nodiscard]] Vector2 displacement(const Observation& o, const Matrix3& rotation) const {
    return focal_ * (turned(rotation, o.ray) - turned(rotation, centers_[o.point]));
  }

  /// Of every observation, after parallax and offsets are solved for this rotation.
  Eigen::VectorXd residuals(const Matrix3& rotation) {
    std::vector<Vector2> moved;
    moved.reserve(observations_.size());
    for (const Observation& o : observations_) moved.push_back(displacement(o, rotation));
    for (int sweep = 0; sweep < kSweeps; ++sweep) solve_once(moved);
    Eigen::VectorXd residual(2 * static_cast<long>(observations_.size()));
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      residual.segment<2>(2 * static_cast<long>(i)) =
          moved[i] + parallax_[o.point] * o.step - offsets_[o.view];
    }
    return residual;
  }

  /// Huber's weights; what is far off counts nothing.
  void weigh(const Eigen::VectorXd& residual) {
    std::vector<double> sizes = sizes_of(residual);
    const double limit = std::max(kHuber, kOutlierMedians * median(sizes));
    sizes = sizes_of(residual);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      observations_[i].weight = sizes[i] > limit ? 0 : (sizes[i] <= kHuber ? 1 : kHuber / sizes[i]);
    }
  }

  [[nodiscard]] Eigen::VectorXd weighted(const Eigen::VectorXd& residual) const {
    Eigen::VectorXd result = residual;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      result.segment<2>(2 * static_cast<long>(i)) *= std::sqrt(observations_[i].weight);
    }
    return result;
  }

  static std::vector<double> sizes_of(const Eigen::VectorXd& residual) {
    std::vector<double> sizes;
    for (long i = 0; i + 1 < residual.size(); i += 2)
      sizes.push_back(residual.segment<2>(i).norm());
    return sizes;
  }
  static double median(std::vector<double>& values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<long>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  }

 private:
  void solve_once(const std::vector<Vector2>& moved) {
    std::vector<double> pull(parallax_.size(), 0.0);
    std::vector<double> weight(parallax_.size(), 1e-9);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      pull[o.point] -= o.weight * o.step.dot(moved[i] - offsets_[o.view]);
      weight[o.point] += o.weight * o.step.squaredNorm();
    }
    for (std::size_t i = 0; i < parallax_.size(); ++i) parallax_[i] = pull[i] / weight[i];
    std::vector<Vector2> sum(offsets_.size(), Vector2::Zero());
    std::vector<double> count(offsets_.size(), 1e-9);
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      const Observation& o = observations_[i];
      sum[o.view] += o.weight * (moved[i] + parallax_[o.point] * o.step);
      count[o.view] += o.weight;
    }
    for (std::size_t v = 0; v < offsets_.size(); ++v) offsets_[v] = sum[v] / count[v];
    remove_trend();
  }

  /// Offsets that grow with the step of the grid are parallax.
  void remove_trend() {
    double along = 0;
    double squares = 0;
    for (std::size_t v = 0; v < offsets_.size(); ++v) {
      along += offsets_[v].dot(steps_[v]);
      squares += steps_[v].squaredNorm();
    }
    const double trend = along / squares;
    for (std::size_t v = 0; v < offsets_.size(); ++v) offsets_[v] -= trend * steps_[v];
    for (double& parallax : parallax_) parallax -= trend;
  }

  double focal_;
  std::vector<Vector2> centers_;
  std::vector<Vector2> steps_;  // Of every view.
  std::vector<Observation> observations_;
  std::vector<double> parallax_;
  std::vector<Vector2> offsets_;
};

/// One step of Gauss and Newton on the rotation vector, numerically: parallax and offsets follow.
Eigen::Vector3d rotation_step(Model& model, const Eigen::Vector3d& vector) {
  constexpr double delta = 1e-4;
  const Eigen::VectorXd residual = model.weighted(model.residuals(rotation_of(vector)));
  Eigen::MatrixXd jacobian(residual.size() + 2, 3);
  Eigen::VectorXd all(residual.size() + 2);
  all << residual, vector.head<2>() * kNoise / kTiltPrior;
  jacobian.bottomRows(2).setZero();
  jacobian(residual.size(), 0) = kNoise / kTiltPrior;
  jacobian(residual.size() + 1, 1) = kNoise / kTiltPrior;
  for (int k = 0; k < 3; ++k) {
    Eigen::Vector3d other = vector;
    other[k] += delta;
    const Eigen::VectorXd moved = model.weighted(model.residuals(rotation_of(other)));
    jacobian.col(k).head(residual.size()) = (moved - residual) / delta;
  }
  return -(jacobian.transpose() * jacobian).ldlt().solve(jacobian.transpose() * all);
}

/// What each view is off, from what parallax does not explain.
std::vector<ViewCorrection> corrections_of(const Model& model, const Matrix3& rotation,
                                           std::size_t views) {
  using Matrix8 = Eigen::Matrix<double, 8, 8>;
  using Vector8 = Eigen::Matrix<double, 8, 1>;
  std::vector<Matrix8> normal(views, Matrix8::Identity() * 1e-6);
  std::vector<Vector8> right(views, Vector8::Zero());
  // Without enough points that spread, a shift is all that can be told.
  for (auto& matrix : normal) matrix.diagonal().tail<7>().array() += 1e-2;
  for (auto& matrix : normal) matrix(3, 3) = 1e-6;
  for (const Observation& o : model.observations()) {
    const Vector2 off = model.displacement(o, rotation) + model.parallax()[o.point] * o.step;
    const Vector2 ray = turned(rotation, o.ray);
    Eigen::Matrix<double, 2, 8> row;
    row << 1, ray.x(), ray.y(), 0, 0, 0, ray.x() * ray.x(), ray.x() * ray.y(), 0, 0, 0, 1, ray.x(),
        ray.y(), ray.x() * ray.y(), ray.y() * ray.y();
    normal[o.view] += o.weight * row.transpose() * row;
    right[o.view] += o.weight * row.transpose() * off;
  }
  std::vector<ViewCorrection> corrections(views);
  for (std::size_t v = 0; v < views; ++v) {
    Eigen::Map<Vector8>(corrections[v].parameters.data()) = normal[v].ldlt().solve(right[v]);
  }
  return corrections;
}

/// Takes from the parameters what grows along rows or columns; of the shift the parallax has it.
void remove_trends(std::vector<ViewCorrection>& corrections, GridShape grid) {
  const ViewIndex middle = grid.center();
  for (const int k : {1, 2, 4, 5, 6, 7}) {
    Eigen::Matrix2d squares = Eigen::Matrix2d::Identity() * 1e-12;
    Vector2 along = Vector2::Zero();
    const auto step_of = [&](int v) {
      const ViewIndex view = grid.view_at(v);
      return Vector2(view.u - middle.u, view.v - middle.v);
    };
    for (int v = 0; v < grid.count(); ++v) {
      squares += step_of(v) * step_of(v).transpose();
      along += corrections[v].parameters[k] * step_of(v);
    }
    const Vector2 trend = squares.ldlt().solve(along);
    for (int v = 0; v < grid.count(); ++v) {
      corrections[v].parameters[k] -= trend.dot(step_of(v));
    }
  }
}

}  // namespace

double Alignment::roll_degrees() const {
  return std::atan2(rotation[3], rotation[0]) * 180 / std::numbers::pi;
}

Alignment align(const ViewMatches& matches, const LensCamera& camera) {
  Model model(matches, camera);
  const ViewIndex middle = matches.grid.center();
  const auto center = static_cast<std::size_t>(middle.v) * matches.grid.u + middle.u;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  for (int round = 0; round < kRounds; ++round) {
    vector += rotation_step(model, vector);
    model.weigh(model.residuals(rotation_of(vector)));
  }
  const Matrix3 rotation = rotation_of(vector);
  std::vector<double> sizes = Model::sizes_of(model.residuals(rotation));
  Alignment alignment;
  alignment.residual_px = Model::median(sizes);
  if (!(alignment.residual_px < kWorstFit)) {
    throw InvalidInput("the photographs do not lie on a grid: points are " +
                       std::to_string(alignment.residual_px) +
                       " px off; check the order of the files, and that the camera fits them");
  }
  Eigen::Map<Matrix3>(alignment.rotation.data()) = rotation;
  alignment.focal_px = model.focal();
  alignment.parallax = model.parallax();
  alignment.corrections = corrections_of(model, rotation, matches.found.size());
  alignment.corrections[center] = {};
  remove_trends(alignment.corrections, matches.grid);
  return alignment;
}

}  // namespace episcope::capture
