// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/order/sign_check.h"

#include "engine/core/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace episcope::io {
namespace {

/// What hides what at depth edges, as seen along one or both view axes.
struct OcclusionVotes {
  /// Points where, by the order of views as stored, the nearer of two surfaces hides the farther
  /// one, and points where it is the other way round, as if the axis were reversed.
  long long forward = 0;
  long long reversed = 0;
  /// Squares of 16×16 px in which most of the points say so: points side by side are no
  /// independent evidence.
  int forward_squares = 0;
  int reversed_squares = 0;

  [[nodiscard]] bool is_decided() const;
  [[nodiscard]] bool says_reversed() const { return reversed_squares > forward_squares; }
  /// The votes if the axis is reversed.
  [[nodiscard]] OcclusionVotes turned() const {
    return {reversed, forward, reversed_squares, forward_squares};
  }
  OcclusionVotes& operator+=(const OcclusionVotes& more);
};

/// Votes of every view axis; none for an axis of fewer than three views.
struct OcclusionByAxis {
  OcclusionVotes u;
  OcclusionVotes v;
};

constexpr int kVoteSquare = 16;
constexpr float kLeastApart = 2;  ///< Shifts that differ by less are of one surface.
constexpr float kClearly = 0.6;
/// Windows that differ by less than this many times the usual error may differ by noise.
constexpr float kWindowAboveNoise = 2.5;
constexpr float kLeastWindowContrast = 0.5;
constexpr double kSignificantVotes = 3.3;  ///< Standard deviations of votes by chance.
/// Systematic errors, such as edges found beside their place, must be clearly fewer.
constexpr double kMajority = 0.35;

/// A point of the middle view that a shift leads to some place.
struct Arrival {
  int x = -1;
  float shift = 0;
};

/// The two surfaces that are led to one place of a view.
struct Arrivals {
  Arrival smallest{-1, std::numeric_limits<float>::max()};
  Arrival largest{-1, std::numeric_limits<float>::lowest()};

  void add(int x, float shift) {
    if (shift < smallest.shift) smallest = {x, shift};
    if (shift > largest.shift) largest = {x, shift};
  }
  [[nodiscard]] bool is_collision() const { return largest.shift - smallest.shift >= kLeastApart; }
};

/// Compares small windows of the middle view with other views.
class Windows {
 public:
  Windows(const Image<float>& middle, const Image<float>& target, const Image<float>& opposite)
      : middle_(middle), target_(target), opposite_(opposite) {}

  /// Sets the contrast above which windows differ by more than noise: from the median error of
  /// windows moved by their own shifts.
  void measure_noise(const Image<float>& shift, float side) {
    std::vector<float> errors;
    for (int y = 1; y < shift.height(); y += 3) {
      for (int x = 1; x < shift.width(); x += 3) {
        const float error = on_opposite(y, x, side * shift.at(y, x));
        if (std::isfinite(error)) errors.push_back(error);
      }
    }
    if (errors.empty()) return;
    contrast_ = kLeastWindowContrast + kWindowAboveNoise * quantile(errors, 0.5);
  }
  [[nodiscard]] float contrast() const { return contrast_; }

  /// How far the window at x, moved by `by`, differs from the target or the opposite view.
  [[nodiscard]] float on_target(int y, int x, float by) const { return error(target_, y, x, by); }
  [[nodiscard]] float on_opposite(int y, int x, float by) const {
    return error(opposite_, y, x, by);
  }

 private:
  [[nodiscard]] float error(const Image<float>& other, int y, int x, float by) const {
    if (!std::isfinite(by)) return by;
    const float place = static_cast<float>(x) + by;
    const int whole = static_cast<int>(std::floor(place));
    if (y < 1 || y >= middle_.height() - 1 || x < 1 || x >= middle_.width() - 1 || whole < 1 ||
        whole >= other.width() - 2) {
      return std::numeric_limits<float>::quiet_NaN();
    }
    const float part = place - static_cast<float>(whole);
    float sum = 0;
    for (int j = -1; j <= 1; ++j) {
      const float* a = middle_.row(y + j) + x;
      const float* b = other.row(y + j) + whole;
      for (int i = -1; i <= 1; ++i) {
        sum += std::abs(a[i] - (1 - part) * b[i] - part * b[i + 1]);
      }
    }
    return sum / 9;
  }

  const Image<float>& middle_;
  const Image<float>& target_;
  const Image<float>& opposite_;
  float contrast_ = kLeastWindowContrast;
};

/// +1 if the point with the larger shift hides the other one, −1 if it is hidden, 0 if that cannot
/// be told. `side` is +1 for the view after the middle one.
int winner(const Windows& windows, int y, const Arrivals& two, float side) {
  const Arrival& p = two.smallest;
  const Arrival& q = two.largest;
  // NaN makes every comparison false.
  const auto moves_alone = [&](const Arrival& one, float other_shift) {
    const float own = windows.on_opposite(y, one.x, side * one.shift);
    const float other = windows.on_opposite(y, one.x, side * other_shift);
    return own < kClearly * other && other > windows.contrast();
  };
  if (!moves_alone(p, q.shift) || !moves_alone(q, p.shift)) return 0;
  const float p_error = windows.on_target(y, p.x, -side * p.shift);
  const float q_error = windows.on_target(y, q.x, -side * q.shift);
  if (q_error < kClearly * p_error && p_error > windows.contrast()) return 1;
  if (p_error < kClearly * q_error && q_error > windows.contrast()) return -1;
  return 0;
}

/// Counts points by squares of the view.
class Tally {
 public:
  Tally(int height, int width)
      : columns_(width / kVoteSquare + 1),
        balance_(static_cast<std::size_t>(columns_) * (height / kVoteSquare + 1)) {}

  void add(int y, int x, int vote) {
    (vote > 0 ? votes_.forward : votes_.reversed) += 1;
    balance_[static_cast<std::size_t>(y / kVoteSquare) * columns_ + x / kVoteSquare] += vote;
  }
  [[nodiscard]] OcclusionVotes votes() const {
    OcclusionVotes all = votes_;
    for (const int square : balance_) {
      if (square > 0) ++all.forward_squares;
      if (square < 0) ++all.reversed_squares;
    }
    return all;
  }

 private:
  int columns_;
  std::vector<int> balance_;
  OcclusionVotes votes_;
};

OcclusionVotes votes_of(const LineMatches& matches) {
  if (matches.shift.empty()) return {};
  const Image<float>& shift = matches.shift;
  Tally tally(shift.height(), shift.width());
  for (const int side : {-1, 1}) {
    Windows windows(matches.views.middle, matches.views.far[side > 0 ? 1 : 0],
                    matches.views.far[side > 0 ? 0 : 1]);
    windows.measure_noise(shift, static_cast<float>(side));
    std::vector<Arrivals> row(static_cast<std::size_t>(shift.width()));
    for (int y = 0; y < shift.height(); ++y) {
      std::ranges::fill(row, Arrivals{});
      for (int x = 0; x < shift.width(); ++x) {
        const float by = shift.at(y, x);
        if (!std::isfinite(by)) continue;
        const int place =
            static_cast<int>(std::lround(static_cast<float>(x) - static_cast<float>(side) * by));
        if (place >= 0 && place < shift.width()) row[static_cast<std::size_t>(place)].add(x, by);
      }
      for (const Arrivals& two : row) {
        if (two.smallest.x < 0 || !two.is_collision()) continue;
        const int vote = winner(windows, y, two, static_cast<float>(side));
        if (vote != 0) tally.add(y, two.smallest.x, vote);
      }
    }
  }
  return tally.votes();
}

OcclusionVotes& OcclusionVotes::operator+=(const OcclusionVotes& more) {
  forward += more.forward;
  reversed += more.reversed;
  forward_squares += more.forward_squares;
  reversed_squares += more.reversed_squares;
  return *this;
}

bool OcclusionVotes::is_decided() const {
  const double sum = forward_squares + reversed_squares;
  const double difference = std::abs(forward_squares - reversed_squares);
  const bool is_agreed = (forward > reversed) == (forward_squares > reversed_squares);
  return is_agreed && difference > kSignificantVotes * std::sqrt(sum) &&
         difference > kMajority * sum;
}

/// Two points of the view at the center of the grid whose disparities lead them to the same place
/// of another view, and which in the opposite view are seen side by side, each with its own motion:
/// the one that is seen in that place is the nearer one. If it has the larger disparity, the axis
/// has the canonical direction. Looks at five views of each axis, reduced to at most `side` px, of
/// them at the middle of 512×512 px. Linear in the range of disparities. Throws Cancelled.
OcclusionByAxis count_occlusions(const CoarseMotion& coarse, int side, const Progress& progress) {
  const auto [u, v] = along_both_axes(
      progress, [&](bool is_v) { return votes_of(match_line(coarse, is_v, side, progress)); });
  return {u, v};
}

constexpr int kLargestVoteSide = 1024;
constexpr int kSmallestVoteSide = 256;

std::string counted(const OcclusionVotes& votes) {
  return fmt::format("{} points to {}, in {} squares of the view to {}",
                     std::max(votes.forward, votes.reversed),
                     std::min(votes.forward, votes.reversed),
                     std::max(votes.forward_squares, votes.reversed_squares),
                     std::min(votes.forward_squares, votes.reversed_squares));
}

/// Both axes together, counted for the order `flip`.
OcclusionVotes votes_for(const OcclusionByAxis& votes, ViewFlip flip) {
  OcclusionVotes sum = flip.u ? votes.u.turned() : votes.u;
  sum += flip.v ? votes.v.turned() : votes.v;
  return sum;
}

SignFinding related_axes(const OcclusionByAxis& votes, ViewFlip flip) {
  const OcclusionVotes sum = votes_for(votes, flip);
  if (!sum.is_decided()) return {flip, false, {}};
  if (sum.says_reversed()) flip = {!flip.u, !flip.v};
  return {flip, true, "occlusion: " + counted(sum)};
}

SignFinding single_axes(const OcclusionByAxis& votes, GridShape grid, ViewFlip flip) {
  const bool needs_u = grid.u > 1;
  const bool needs_v = grid.v > 1;
  SignFinding found{flip, false, {}};
  found.is_decided = (!needs_u || votes.u.is_decided()) && (!needs_v || votes.v.is_decided());
  if (!found.is_decided) return found;
  if (needs_u) found.flip.u = votes.u.says_reversed();
  if (needs_v) found.flip.v = votes.v.says_reversed();
  found.evidence = "occlusion: ";
  if (needs_u) found.evidence += "along u " + counted(votes.u);
  if (needs_u && needs_v) found.evidence += "; ";
  if (needs_v) found.evidence += "along v " + counted(votes.v);
  return found;
}

}  // namespace

SignFinding check_sign(const CoarseMotion& coarse, ViewFlip flip, bool are_axes_related,
                       const Progress& progress) {
  const auto [grid, larger] = std::visit(
      [](const auto& stack) {
        return std::pair(stack.grid(), std::max(stack.width(), stack.height()));
      },
      coarse.samples());
  SignFinding found{flip, false, {}};
  if (std::max(grid.u, grid.v) < 3) {
    found.evidence = "occlusion cannot be seen in fewer than three views in a row";
    return found;
  }
  OcclusionVotes most;
  for (int side = std::min(larger, kLargestVoteSide); side >= std::min(kSmallestVoteSide, larger);
       side = (side + 1) / 2) {
    progress.check();
    const OcclusionByAxis votes = count_occlusions(coarse, side, progress);
    found = are_axes_related ? related_axes(votes, flip) : single_axes(votes, grid, flip);
    if (found.is_decided) return found;
    const OcclusionVotes sum = votes_for(votes, flip);
    if (sum.forward + sum.reversed > most.forward + most.reversed) most = sum;
    if (side <= kSmallestVoteSide) break;
  }
  found.evidence =
      fmt::format("no depth edges with clear occlusion: {} points for this order, {} against",
                  most.forward, most.reversed);
  return found;
}

}  // namespace episcope::io
