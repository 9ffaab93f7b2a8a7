// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/line_check.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/box_mean.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/epi/line_residuals.h"
#include "engine/disparity/epi/side_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

// The smallest difference distinguishable from rounding and resampling.
constexpr float kMinDifference = 1.0F / 255;
constexpr int kTextureRadius = 2;
constexpr float kTextureGain = 4;

float squared_difference(std::uint32_t a, std::uint32_t b) {
  int sum = 0;
  for (int c = 0; c < 3; ++c) {
    const int off = packed_channel(a, c) - packed_channel(b, c);
    sum += off * off;
  }
  return static_cast<float>(sum) / (1023.0F * 1023.0F);
}

// Squared gradients of one view: both differences along each axis, and the smaller of the two.
struct Gradients {
  Image<float> mean, own;
};

void add_axis(float before, float after, bool has_before, bool has_after, float& mean, float& own) {
  if (!has_before) before = after;
  if (!has_after) after = before;
  mean += 0.5F * (before + after);
  own += std::min(before, after);
}

void measure_gradients(const ImageView<const std::uint32_t>& view, Gradients& gradients) {
  for (int y = 0; y < view.height; ++y) {
    const std::uint32_t* const row = view.row(y);
    const std::uint32_t* const above = view.row(std::max(y - 1, 0));
    const std::uint32_t* const below = view.row(std::min(y + 1, view.height - 1));
    for (int x = 0; x < view.width; ++x) {
      const bool left = x > 0, right = x + 1 < view.width;
      float mean = 0, own = 0;
      add_axis(left ? squared_difference(row[x - 1], row[x]) : 0,
               right ? squared_difference(row[x], row[x + 1]) : 0, left, right, mean, own);
      add_axis(squared_difference(above[x], row[x]), squared_difference(row[x], below[x]), y > 0,
               y + 1 < view.height, mean, own);
      gradients.mean.at(y, x) = mean;
      gradients.own.at(y, x) = own;
    }
  }
}

class TextureTrust {
 public:
  TextureTrust(int height, int width)
      : gradients_{Image<float>(height, width), Image<float>(height, width)},
        column_(width),
        window_(width) {}

  void begin(const ImageView<const std::uint32_t>& view) { measure_gradients(view, gradients_); }

  void multiply_row(int y, float noise, float* trust) {
    const int width = gradients_.own.width();
    const int rows_summed = sum_rows(gradients_.mean, y, kTextureRadius, column_.data());
    box_mean_row(column_.data(), width, kTextureRadius, window_.data());
    const float* const own = gradients_.own.row(y);
    const float rows = 1.0F / static_cast<float>(rows_summed);
    for (int x = 0; x < width; ++x) {
      const float share = kTextureGain * (own[x] + noise) / (rows * window_[x] + noise);
      trust[x] *= std::min(share, 1.0F);
    }
  }

 private:
  Gradients gradients_;
  std::vector<float> column_, window_;
};

void line_trust_row(const float* residual, int width, float variance, float noise, float* trust) {
  for (int x = 0; x < width; ++x) {
    if (!std::isfinite(residual[x])) {  // no side can tell
      trust[x] = 1;
      continue;
    }
    trust[x] = noise / (noise + std::max(0.0F, residual[x] - variance));
  }
}

}  // namespace

Schema<LineCheck> line_check_schema() {
  return Schema<LineCheck>()
      .flag("choose_sides", &LineCheck::chooses_sides,
            {"Choose sides",
             "Near a jump of disparity, give each pixel the disparity of the side whose lines it "
             "fits, in half of the views at least"})
      .flag("check_lines", &LineCheck::is_on,
            {"Check lines",
             "Reduce the confidence of estimates where other views show a different colour along "
             "the line, or where the texture belongs to a neighbouring pixel"});
}

void check_lines(const LightField& lf, const LineCheck& check, Estimate& estimate,
                 const Progress& progress) {
  if (!check.does_anything()) return;
  check_lines(pack_views(lf, progress.part(0, 0.1)), check, estimate, progress.part(0.1, 1));
}

void check_lines(const PackedViews& views, const LineCheck& check, Estimate& estimate,
                 const Progress& progress) {
  if (!check.does_anything()) return;
  progress.step("checking lines");
  if (check.chooses_sides) choose_sides(views, estimate, progress.part(0, 0.7));
  if (check.is_on) reduce_confidence(views, estimate, progress.part(0.7, 1));
}

void reduce_confidence(const LightField& lf, Estimate& estimate, const Progress& progress) {
  reduce_confidence(pack_views(lf, progress.part(0, 0.2)), estimate, progress.part(0.2, 1));
}

void reduce_confidence(const PackedViews& views, Estimate& estimate, const Progress& progress) {
  const int height = views.pixels.height(), width = views.pixels.width();
  const ViewStack<float>& disparity = estimate.field.disparity;
  const float variance = residual_noise(views, disparity);
  const float noise = kMinDifference * kMinDifference + variance;
  const GridShape grid = disparity.grid();
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, residuals = LineResiduals(views), texture = TextureTrust(height, width),
            trust = std::vector<float>(width)](int i) mutable {
      const ViewIndex view = grid.view_at(i, disparity.first());
      residuals.begin(view);
      texture.begin(views.pixels.view(view));
      const ImageView<float> confidence = estimate.confidence.view(view);
      for (int y = 0; y < height; ++y) {
        if (y % 16 == 0) progress.check();
        line_trust_row(residuals.row(y, disparity.view(view).row(y)), width, variance, noise,
                       trust.data());
        texture.multiply_row(y, noise, trust.data());
        float* const row = confidence.row(y);
        for (int x = 0; x < width; ++x) row[x] *= std::sqrt(std::sqrt(trust[x]));
      }
    };
  });
}

}  // namespace episcope
