// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/order/occlusion_votes.h"

#include "engine/io/order/both_axes.h"
#include "engine/io/order/line_matches.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kSquare = 16;
constexpr float kLeastApart = 2;  ///< Shifts that differ by less are of one surface.
constexpr float kClearly = 0.6;
/// Windows that differ by less than this many times the usual error may differ by noise.
constexpr float kAboveNoise = 2.5;
constexpr float kLeastContrast = 0.5;
constexpr double kSignificant = 3.3;  ///< Standard deviations of votes by chance.
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
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    contrast_ = kLeastContrast + kAboveNoise * *middle;
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
  float contrast_ = kLeastContrast;
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
      : columns_(width / kSquare + 1),
        balance_(static_cast<std::size_t>(columns_) * (height / kSquare + 1)) {}

  void add(int y, int x, int vote) {
    (vote > 0 ? votes_.forward : votes_.reversed) += 1;
    balance_[static_cast<std::size_t>(y / kSquare) * columns_ + x / kSquare] += vote;
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

}  // namespace

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
  return is_agreed && difference > kSignificant * std::sqrt(sum) && difference > kMajority * sum;
}

OcclusionByAxis count_occlusions(const LightField::Samples& samples, int side,
                                 const Progress& progress) {
  const auto [u, v] = along_both_axes(
      progress, [&](bool is_v) { return votes_of(match_line(samples, is_v, side, progress)); });
  return {u, v};
}

}  // namespace episcope::io
