// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/multi_camera_energy.h"

#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace episcope {
namespace {

SideView side_view(ViewIndex view, ViewIndex reference, const std::vector<float>& labels) {
  SideView side{.view = view, .is_vertical = view.v != reference.v};
  const int steps = side.is_vertical ? view.v - reference.v : view.u - reference.u;
  for (const float label : labels) {
    const float exact = -label * static_cast<float>(steps);
    side.shift.push_back(static_cast<int>(std::lround(exact)));
    side.beyond.push_back(exact - static_cast<float>(side.shift.back()));
  }
  return side;
}

// Rows in which K is measured, and the least it can be: a step of 8-bit samples, squared.
constexpr int kProbedEnergyRows = 48;
constexpr double kMinLimit = 1;
constexpr double kPublishedLimit = 30;
constexpr double kLimitInLeast = 3;

// Four samples of a row or column around a place between pixels, Catmull-Rom.
struct SampleTaps {
  int first = -1;
  std::array<float, 4> weights{};
};

// At `t` in [−½, ½] from a pixel.
SampleTaps taps_at(float t) {
  SampleTaps taps{.first = t < 0 ? -2 : -1};
  if (t < 0) t += 1;
  taps.weights = {t * (-0.5F + t * (1 - 0.5F * t)), 1 + t * t * (-2.5F + 1.5F * t),
                  t * (0.5F + t * (2 - 1.5F * t)), t * t * (-0.5F + 0.5F * t)};
  return taps;
}

// Adds the squared differences between samples and others interpolated `step` apart.
void add_squares(const float* samples, const float* others, const SampleTaps& taps, long step,
                 int count, float scale, float* out) {
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

// Neighbors that differ less belong to one surface, so more speaks against a jump there.
constexpr float kAlike = 8;
constexpr std::int32_t kAlikeFactor = 3;

// λ_pq of every pixel and the one `dy` rows below and `dx` columns to the right.
Image<std::int32_t> neighbor_weights(const CameraImage& image, int height, int width, int dy,
                                     int dx, std::int32_t weight) {
  Image<std::int32_t> weights(height, width);
  for (int y = 0; y < height - dy; ++y) {
    for (int x = 0; x < width - dx; ++x) {
      bool alike = true;
      for (int c = 0; c < image.channels(); ++c) {
        alike = alike && std::fabs(image.row(c, y)[x] - image.row(c, y + dy)[x + dx]) < kAlike;
      }
      weights.at(y, x) = alike ? kAlikeFactor * weight : weight;
    }
  }
  return weights;
}

}  // namespace

std::vector<SideView> side_views(GridShape grid, ViewIndex reference, int distance,
                                 const std::vector<float>& labels) {
  std::vector<SideView> sides;
  const auto add = [&](int v, int u) {
    const ViewIndex view{std::clamp(v, 0, grid.v - 1), std::clamp(u, 0, grid.u - 1)};
    if (view != reference) sides.push_back(side_view(view, reference, labels));
  };
  add(reference.v, reference.u - distance);
  add(reference.v, reference.u + distance);
  add(reference.v - distance, reference.u);
  add(reference.v + distance, reference.u);
  return sides;
}

CameraImage::CameraImage(const LightField& lf, ViewIndex view) {
  const int height = lf.height(), width = lf.width(), channels = lf.channels();
  const Image<float> samples = lf.view_as_float(view);
  for (int c = 0; c < channels; ++c) {
    Image<float>& plane = planes_.emplace_back(height + 2 * kMargin, width + 2 * kMargin);
    for (int row = 0; row < plane.height(); ++row) {
      const int y = std::clamp(row - kMargin, 0, height - 1);
      for (int column = 0; column < plane.width(); ++column) {
        const int x = std::clamp(column - kMargin, 0, width - 1);
        plane.at(row, column) = lf.is_valid(view, y, x) ? 255 * samples.at(y, x, c)
                                                        : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

Names<PixelComparison> names_of(PixelComparison) {
  return {{PixelComparison::BetweenPixels, "between_pixels", "between pixels"},
          {PixelComparison::WholePixels, "whole_pixels", "whole pixels"}};
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
    if (comparison_ == PixelComparison::WholePixels) {
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
  const int rows = std::min(kProbedEnergyRows, height_);
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

MultiCameraEnergy::MultiCameraEnergy(const Interactions& interactions, CameraSmoothness smoothness)
    : interactions_(interactions), truncation_(smoothness.truncation) {
  const int height = interactions.height(), width = interactions.width();
  for (int view = 0; view <= static_cast<int>(interactions.sides().size()); ++view) {
    const CameraImage& image = interactions.image(view);
    to_right_.push_back(neighbor_weights(image, height, width, 0, 1, smoothness.weight));
    below_.push_back(neighbor_weights(image, height, width, 1, 0, smoothness.weight));
  }
}

CameraLabels MultiCameraEnergy::farthest() const {
  return CameraLabels(views(), Image<std::int16_t>(interactions_.height(), interactions_.width()));
}

std::int64_t MultiCameraEnergy::smoothness_of(const CameraLabels& labels) const {
  std::int64_t sum = 0;
  for (int view = 0; view < views(); ++view) {
    const Image<std::int16_t>& f = labels[view];
    for (int y = 0; y < f.height(); ++y) {
      for (int x = 0; x < f.width(); ++x) {
        const int here = f.at(y, x);
        const auto jump = [&](int y1, int x1) {
          return std::min(std::abs(here - f.at(y1, x1)), truncation_);
        };
        if (x + 1 < f.width()) sum += to_right(view, y)[x] * jump(y, x + 1);
        if (y + 1 < f.height()) sum += below(view, y)[x] * jump(y + 1, x);
      }
    }
  }
  return sum;
}

bool MultiCameraEnergy::is_visible(const CameraLabels& labels) const {
  const Image<std::int16_t>& reference = labels[0];
  const auto blocked = [](const Image<std::int16_t>& f, PixelIndex at, int label) {
    return at.y >= 0 && at.y < f.height() && at.x >= 0 && at.x < f.width() &&
           f.at(at.y, at.x) < label;
  };
  for (int side = 0; side + 1 < views(); ++side) {
    const SideView& there = interactions_.sides()[side];
    const Image<std::int16_t>& other = labels[side + 1];
    for (int y = 0; y < reference.height(); ++y) {
      for (int x = 0; x < reference.width(); ++x) {
        const int p = reference.at(y, x), q = other.at(y, x);
        if (blocked(other, there.place(y, x, p), p)) return false;
        if (blocked(reference, there.place_in_reference(y, x, q), q)) return false;
      }
    }
  }
  return true;
}

std::optional<std::int64_t> MultiCameraEnergy::of(const CameraLabels& labels) const {
  if (!is_visible(labels)) return std::nullopt;
  std::int64_t sum = smoothness_of(labels);
  const Image<std::int16_t>& reference = labels[0];
  std::vector<std::int32_t> gains(reference.width());
  for (int side = 0; side + 1 < views(); ++side) {
    const SideView& there = interactions_.sides()[side];
    for (int y = 0; y < reference.height(); ++y) {
      for (int label = 0; label < interactions_.labels(); ++label) {
        interactions_.gains(side, label, y, gains.data());
        for (int x = 0; x < reference.width(); ++x) {
          if (gains[x] == 0 || reference.at(y, x) != label) continue;
          const PixelIndex q = there.place(y, x, label);
          if (labels[side + 1].at(q.y, q.x) == label) sum += gains[x];
        }
      }
    }
  }
  return sum;
}

}  // namespace episcope
