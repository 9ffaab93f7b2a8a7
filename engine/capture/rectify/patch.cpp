// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/rectify/patch.h"

#include <Eigen/Dense>

#include <cmath>

namespace episcope::capture {
namespace {

constexpr int kMostSteps = 15;
constexpr double kConverged = 2e-3;   // px
constexpr double kFarthest = 2;       // px from the guess
constexpr double kLeastContrast = 2;  // grey levels
constexpr double kAlike = 0.35;       // difference by contrast

/// Weights of Catmull and Rom's cubic.
std::array<float, 4> cubic(double t) {
  const double tt = t * t;
  const double ttt = tt * t;
  return {static_cast<float>((-ttt + 2 * tt - t) / 2),
          static_cast<float>((3 * ttt - 5 * tt + 2) / 2),
          static_cast<float>((-3 * ttt + 4 * tt + t) / 2), static_cast<float>((ttt - tt) / 2)};
}

/// The square of a picture around a place; false if it is not inside.
bool sample(ImageView<const float> picture, const PlanePoint& at,
            std::array<float, Patch::kSide * Patch::kSide>& out) {
  constexpr int side = Patch::kSide;
  const int x0 = static_cast<int>(std::floor(at.x)) - Patch::kReach - 1;
  const int y0 = static_cast<int>(std::floor(at.y)) - Patch::kReach - 1;
  if (x0 < 0 || y0 < 0 || x0 + side + 3 > picture.width || y0 + side + 3 > picture.height) {
    return false;
  }
  const auto wx = cubic(at.x - std::floor(at.x));
  const auto wy = cubic(at.y - std::floor(at.y));
  float rows[side + 3][side];
  for (int y = 0; y < side + 3; ++y) {
    const float* row = picture.row(y0 + y) + x0;
    for (int x = 0; x < side; ++x) {
      rows[y][x] = wx[0] * row[x] + wx[1] * row[x + 1] + wx[2] * row[x + 2] + wx[3] * row[x + 3];
    }
  }
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      out[y * side + x] = wy[0] * rows[y][x] + wy[1] * rows[y + 1][x] + wy[2] * rows[y + 2][x] +
                          wy[3] * rows[y + 3][x];
    }
  }
  return true;
}

}  // namespace

Patch::Patch(ImageView<const float> picture, int y, int x) {
  Eigen::Matrix<double, kCount, 4> jacobian;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < kCount; ++i) {
    const int py = y + i / kSide - kReach;
    const int px = x + i % kSide - kReach;
    const double value = picture.at(py, px);
    template_[i] = static_cast<float>(value);
    jacobian.row(i) << (picture.at(py, px + 1) - picture.at(py, px - 1)) / 2,
        (picture.at(py + 1, px) - picture.at(py - 1, px)) / 2, value, 1;
    sum += value;
    squares += value * value;
  }
  contrast_ = std::sqrt(std::max(0.0, squares / kCount - (sum / kCount) * (sum / kCount)));
  const Eigen::Matrix4d normal = jacobian.transpose() * jacobian;
  const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
  if (contrast_ < kLeastContrast || solver.rcond() < 1e-14) {
    contrast_ = 0;
    return;
  }
  const Eigen::Matrix<double, 4, kCount> update = solver.solve(jacobian.transpose());
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < kCount; ++i) update_[k][i] = static_cast<float>(update(k, i));
  }
}

std::optional<PatchMatch> Patch::find(ImageView<const float> picture,
                                      const PlanePoint& guess) const {
  if (contrast_ == 0) return {};
  std::array<float, kCount> seen;
  PlanePoint at = guess;
  double gain = 1;
  double offset = 0;
  for (int step = 0; step < kMostSteps; ++step) {
    if (!sample(picture, at, seen)) return {};
    double by[4] = {};
    double squares = 0;
    for (int i = 0; i < kCount; ++i) {
      const float error =
          seen[i] - static_cast<float>(gain) * template_[i] - static_cast<float>(offset);
      squares += static_cast<double>(error) * error;
      for (int k = 0; k < 4; ++k) by[k] += update_[k][i] * error;
    }
    at.x -= by[0];
    at.y -= by[1];
    gain += by[2];
    offset += by[3];
    const double off = std::hypot(at.x - guess.x, at.y - guess.y);
    if (!(off <= kFarthest) || gain < 0.3 || gain > 3) return {};
    if (std::hypot(by[0], by[1]) > kConverged) continue;
    const bool is_alike = std::sqrt(squares / kCount) < kAlike * contrast_ * gain;
    return is_alike ? std::optional(PatchMatch{at, gain}) : std::nullopt;
  }
  return {};
}

}  // namespace episcope::capture
