// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/cuts/interactions.h"

#include "engine/core/array/quantile.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace episcope {
namespace {

// Rows in which K is measured, and the least it can be: a step of 8-bit samples, squared.
constexpr int kProbedRows = 48;
constexpr double kMinLimit = 1;
constexpr double kPublishedLimit = 30;
constexpr double kLimitInLeast = 3;

// Four samples of a row or column around a place between pixels, Catmull-Rom.
struct Taps {
  int first = -1;
  std::array<float, 4> weights{};
};

// At `t` in [−½, ½] from a pixel.
Taps taps_at(float t) {
  Taps taps{.first = t < 0 ? -2 : -1};
  if (t < 0) t += 1;
  taps.weights = {t * (-0.5F + t * (1 - 0.5F * t)), 1 + t * t * (-2.5F + 1.5F * t),
                  t * (0.5F + t * (2 - 1.5F * t)), t * t * (-0.5F + 0.5F * t)};
  return taps;
}

// Adds the squared differences between samples and others interpolated `step` apart.
void add_squares(const float* samples, const float* others, const Taps& taps, long step, int count,
                 float scale, float* out) {
  const float* const from = others + taps.first * step;
  const auto [a, b, c, d] = taps.weights;
  for (int x = 0; x < count; ++x) {
    const float other =
        a * from[x] + b * from[x + step] + c * from[x + 2 * step] + d * from[x + 3 * step];
    const float difference = samples[x] - other;
    out[x] += scale * difference * difference;
  }
}

void add_squares(const float* samples, const float* others, int count, float scale, float* out) {
  for (int x = 0; x < count; ++x) {
    const float difference = samples[x] - others[x];
    out[x] += scale * difference * difference;
  }
}

}  // namespace

Names<Comparison> names_of(Comparison) {
  return {{Comparison::BetweenPixels, "between_pixels", "between pixels"},
          {Comparison::WholePixels, "whole_pixels", "whole pixels"}};
}

Names<LimitRule> names_of(LimitRule) {
  return {{LimitRule::Noise, "noise"}, {LimitRule::Quarter, "quarter", "quarter of the labels"}};
}

Interactions::Interactions(const LightField& lf, ViewIndex reference, std::vector<SideView> sides,
                           const Matching& matching, const Progress& progress)
    : height_(lf.height()),
      width_(lf.width()),
      comparison_(matching.comparison),
      limit_(matching.limit),
      sides_(std::move(sides)) {
  images_.emplace_back(lf, reference);
  for (const SideView& side : sides_) {
    progress.check();
    images_.emplace_back(lf, side.view);
  }
  if (limit_ == 0) find_limit(matching.rule, progress);
}

Interactions::Seen Interactions::differences(int side, int label, int y, float* out) const {
  const SideView& there = sides_[side];
  const PixelIndex at = there.place(y, 0, label);
  if (at.y < 0 || at.y >= height_) return {};
  const Seen seen{std::clamp(-at.x, 0, width_), std::clamp(width_ - at.x, 0, width_)};
  const int count = seen.last - seen.first;
  if (count <= 0) return {};
  const CameraImage &here = images_[0], &other = images_[side + 1];
  std::fill_n(out + seen.first, count, 0.0F);
  const float beyond = there.beyond[label];
  const long step = there.is_vertical ? here.pitch() : 1;
  const auto channels = static_cast<float>(here.channels());
  for (int c = 0; c < here.channels(); ++c) {
    const float* const p = here.row(c, y) + seen.first;
    const float* const q = other.row(c, at.y) + at.x + seen.first;
    if (comparison_ == Comparison::WholePixels) {
      add_squares(p, q, count, 1 / channels, out + seen.first);
    } else {
      add_squares(p, q, taps_at(beyond), step, count, 0.5F / channels, out + seen.first);
      add_squares(q, p, taps_at(-beyond), step, count, 0.5F / channels, out + seen.first);
    }
  }
  return seen;
}

void Interactions::gains(int side, int label, int y, std::int32_t* out) const {
  thread_local std::vector<float> squares;
  squares.resize(width_);
  const Seen seen = differences(side, label, y, squares.data());
  std::fill_n(out, seen.first, 0);
  const auto scale = static_cast<float>(kUnit / limit_);
  for (int x = seen.first; x < seen.last; ++x) {
    const float gain = squares[x] * scale - kUnit;  // NaN gains nothing
    out[x] = gain < 0 ? static_cast<std::int32_t>(gain - 0.5F) : 0;
  }
  std::fill(out + seen.last, out + width_, 0);
}

// The differences of each pixel of a row and side view that see a point, sorted by label: the one
// of that rank.
std::vector<float> Interactions::differences_of_rank(int y, int rank) const {
  std::vector<float> found, of_pixel(labels());
  Image<float> all(labels(), width_);
  for (int side = 0; side < static_cast<int>(sides_.size()); ++side) {
    std::fill(all.begin(), all.end(), INFINITY);
    for (int label = 0; label < labels(); ++label) {
      (void)differences(side, label, y, all.row(label));
    }
    for (int x = 0; x < width_; ++x) {
      for (int label = 0; label < labels(); ++label) of_pixel[label] = all.at(label, x);
      // NaN must not be sorted.
      std::ranges::replace_if(
          of_pixel, [](float d) { return !(d < INFINITY); }, INFINITY);
      std::ranges::nth_element(of_pixel, of_pixel.begin() + rank);
      if (of_pixel[rank] < INFINITY) found.push_back(of_pixel[rank]);
    }
  }
  return found;
}

void Interactions::find_limit(LimitRule rule, const Progress& progress) {
  const int rows = std::min(kProbedRows, height_);
  const int quarter = std::clamp(labels() / 4, std::min(3, labels()), labels()) - 1;
  std::vector<std::vector<float>> of_rows(rows);
  parallel_for(rows, progress, [&](int i) {
    const int y = (2 * i + 1) * height_ / (2 * rows);
    of_rows[i] = differences_of_rank(y, rule == LimitRule::Quarter ? quarter : 0);
  });
  std::vector<float> all;
  for (const std::vector<float>& row : of_rows) all.insert(all.end(), row.begin(), row.end());
  limit_ = rule == LimitRule::Quarter ? kMinLimit : kPublishedLimit;
  if (all.empty()) return;
  const double mean =
      std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  limit_ = std::max(limit_, rule == LimitRule::Quarter ? mean : kLimitInLeast * quantile(all, 0.5));
}

}  // namespace episcope
