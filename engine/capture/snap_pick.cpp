// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/snap_pick.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace episcope::capture {
namespace {

constexpr int kSnapRounds = 20;
constexpr double kSettled_px = 1e-3;
constexpr double kLeastGradient = 3;   // RMS in the window, 1/255 per px
constexpr double kLeastBalance = 0.1;  // Smaller over larger eigenvalue.

/// Lines through the pixels of a window, weighted, and the point that is nearest to all.
struct Lines {
  Eigen::Matrix2d matrix = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double constant = 0;
  double weight = 0;

  /// The line through `at` with this normal, of any length.
  void add(const Eigen::Vector2d& at, const Eigen::Vector2d& normal, double w) {
    const double offset = normal.dot(at);
    matrix += w * normal * normal.transpose();
    right += w * offset * normal;
    constant += w * offset * offset;
    weight += w;
  }

  [[nodiscard]] bool is_determined() const {
    const Eigen::Vector2d eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(matrix, Eigen::EigenvaluesOnly)
            .eigenvalues();
    return matrix.trace() > kLeastGradient * kLeastGradient * weight &&
           eigenvalues[0] > kLeastBalance * eigenvalues[1];
  }
  [[nodiscard]] Eigen::Vector2d nearest() const { return matrix.inverse() * right; }
  /// Sum of squares of what lines miss their nearest point by.
  [[nodiscard]] double misses() const { return constant - right.dot(nearest()); }
};

/// Lines along the edges (corner) or along the gradients (blob) around a point.
Lines lines_around(ImageView<const float> gray, const Eigen::Vector2d& center, double reach,
                   MarkKind kind) {
  Lines lines;
  const double sigma = reach / 2;
  const int top = std::max(1, static_cast<int>(std::ceil(center.y() - 2 * reach)));
  const int bottom =
      std::min(gray.height - 2, static_cast<int>(std::floor(center.y() + 2 * reach)));
  const int left = std::max(1, static_cast<int>(std::ceil(center.x() - 2 * reach)));
  const int right = std::min(gray.width - 2, static_cast<int>(std::floor(center.x() + 2 * reach)));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const Eigen::Vector2d at(x, y);
      const double w = std::exp(-(at - center).squaredNorm() / (2 * sigma * sigma));
      const double gx = 0.5 * (gray.at(y, x + 1) - gray.at(y, x - 1));
      const double gy = 0.5 * (gray.at(y + 1, x) - gray.at(y - 1, x));
      // Relative to the center, where sums of squares lose no digits.
      lines.add(at - center,
                kind == MarkKind::Corner ? Eigen::Vector2d(gx, gy) : Eigen::Vector2d(-gy, gx), w);
    }
  }
  return lines;
}

struct Found {
  Eigen::Vector2d place;
  double misses = std::numeric_limits<double>::infinity();
};

std::optional<Found> find(ImageView<const float> gray, const Eigen::Vector2d& pick, double reach,
                          MarkKind kind) {
  Eigen::Vector2d place = pick;
  for (int round = 0; round < kSnapRounds; ++round) {
    const Lines lines = lines_around(gray, place, reach, kind);
    if (!lines.is_determined()) return {};
    const Eigen::Vector2d move = lines.nearest();
    place += move;
    if ((place - pick).norm() > reach) return {};
    if (move.norm() < kSettled_px) return Found{place, lines.misses() / lines.matrix.trace()};
  }
  return {};
}

}  // namespace

std::optional<SnappedPick> snap_pick(ImageView<const float> gray, const PlanePoint& pick,
                                     double reach_px) {
  std::optional<SnappedPick> best;
  double misses = std::numeric_limits<double>::infinity();
  for (const MarkKind kind : {MarkKind::Corner, MarkKind::Blob}) {
    const auto found = find(gray, {pick.x, pick.y}, reach_px, kind);
    if (!found || found->misses >= misses) continue;
    misses = found->misses;
    best = SnappedPick{{found->place.x(), found->place.y()}, kind};
  }
  return best;
}

}  // namespace episcope::capture
