// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/side_choice.h"

#include "engine/core/parallel/isa.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/epi/line_residuals.h"
#include "engine/disparity/epi/side_choice_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace episcope {
namespace {

constexpr int kReach = 6;  // px
constexpr std::array<PixelIndex, kNeighbours> kOffsets = {{{-3, -3},
                                                           {-3, 0},
                                                           {-3, 3},
                                                           {0, -3},
                                                           {0, 3},
                                                           {3, -3},
                                                           {3, 0},
                                                           {3, 3},
                                                           {-kReach, 0},
                                                           {0, -kReach},
                                                           {0, kReach},
                                                           {kReach, 0}}};
constexpr float kMinDifference = 1.0F / 255;  // beyond rounding and resampling
constexpr float kCap = 3;                     // of residuals, in variances of the noise
constexpr float kColorScale = 8.0F / 255;
constexpr float kLeastStep = 0.2F;
constexpr float kFarAdvantage = 0.95F, kNearAdvantage = 0.8F;
constexpr float kFarTrust = 0.2F;
constexpr float kDoubtfulStep = 0.5F, kDoubtfulShare = 0.25F, kRelief = 1.5F;
constexpr float kNoPixel = 100;  // as a colour: similar to none
constexpr int kBandRows = 48;

// The rows of a map with their ends repeated, so that all neighbours can be read.
Image<float> padded(ImageView<const float> map) {
  Image<float> wide(map.height, map.width + 2 * kReach + kSideSlack);
  for (int y = 0; y < map.height; ++y) {
    const float* const from = map.row(y);
    float* const to = wide.row(y);
    std::fill_n(to, kReach, from[0]);
    std::copy_n(from, map.width, to + kReach);
    std::fill(to + kReach + map.width, to + wide.width(), from[map.width - 1]);
  }
  return wide;
}

// One view as it was, padded.
struct Before {
  ViewIndex view;
  Image<float> disparity, confidence;
};

// Decides bands of rows of one view; one per thread.
class SideChooser {
 public:
  SideChooser(const PackedViews& views, float variance, const Before& before);

  // Rows of the view from `begin` on, at most kBandRows.
  void decide(int begin, int end, ImageView<float> disparity, ImageView<float> confidence) {
    begin_ = begin - kVoteRadius;
    const int rows = end - begin + 2 * kVoteRadius;
    for (int j = 0; j < rows; ++j) find_sides(j);
    for (int j = 0; j < rows; ++j) measure(j, rows);
    for (int j = kVoteRadius; j + kVoteRadius < rows; ++j) {
      if (has_jump_[j]) choose(j, disparity.row(begin_ + j), confidence.row(begin_ + j));
    }
  }

 private:
  enum Side { Far, Near, FarConfidence, NearConfidence };
  static constexpr int kRows = kBandRows + 2 * kVoteRadius;

  [[nodiscard]] bool is_inside(int j) const { return begin_ + j >= 0 && begin_ + j < height_; }
  void find_sides(int j);
  void measure(int j, int rows);
  void add_residuals(int j, int of, const float* disparity);
  void choose(int j, float* disparity, float* confidence);

  const PackedViews& views_;
  const Before& before_;
  const SideKernel& kernel_ = EPISCOPE_CHOOSE_KERNEL(best_isa(), kSideKernel);
  int height_, width_;
  float cap_;
  int begin_ = 0;  // the image row of row 0 of the band, which has kVoteRadius rows around
  LineResiduals residuals_;
  Image<float> sides_[4], residual_[3], color_[3];
  std::vector<float> own_[2];
  std::array<bool, kRows> has_jump_{};
  SideRow row_;
};

SideChooser::SideChooser(const PackedViews& views, float variance, const Before& before)
    : views_(views),
      before_(before),
      height_(views.pixels.height()),
      width_(views.pixels.width()),
      cap_(kCap * (variance + kMinDifference * kMinDifference)),
      residuals_(views) {
  const int wide = width_ + 2 * kVoteRadius + kSideSlack;
  for (Image<float>& side : sides_) side = Image<float>(kRows, width_ + kSideSlack);
  for (Image<float>& residual : residual_) residual = Image<float>(kRows, wide);
  for (Image<float>& color : color_) color = Image<float>(kRows, wide, 1, kNoPixel);
  for (std::vector<float>& own : own_) own.resize(width_ + kSideSlack);
  row_.width = width_;
  row_.sharpness = 1 / (8 * (kColorScale * kColorScale + 2 * variance));
  row_.least_step = kLeastStep;
  row_.far_advantage = kFarAdvantage;
  row_.near_advantage = kNearAdvantage;
  row_.doubtful_step = kDoubtfulStep;
  row_.doubtful_share = kDoubtfulShare;
  row_.relief = kRelief;
  residuals_.begin(before.view);
}

void SideChooser::find_sides(int j) {
  has_jump_[j] = false;
  if (!is_inside(j)) return;
  NeighbourRow row;
  row.width = width_;
  for (int k = 0; k < kNeighbours; ++k) {
    const int y = std::clamp(begin_ + j + kOffsets[k].y, 0, height_ - 1);
    const int x = kReach + kOffsets[k].x;
    row.disparity[k] = before_.disparity.row(y) + x;
    row.confidence[k] = before_.confidence.row(y) + x;
  }
  row.far_trust = kFarTrust;
  row.own_disparity = before_.disparity.row(begin_ + j) + kReach;
  row.own_confidence = before_.confidence.row(begin_ + j) + kReach;
  row.far = sides_[Far].row(j);
  row.near = sides_[Near].row(j);
  row.far_confidence = sides_[FarConfidence].row(j);
  row.near_confidence = sides_[NearConfidence].row(j);
  kernel_.gather(row);
  for (int x = 0; x < width_; ++x) {
    const float own = row.own_disparity[x];
    has_jump_[j] |= own - row.far[x] > kLeastStep || row.near[x] - own > kLeastStep;
  }
}

// Residuals and colours of a row, if a row that it votes on has a jump.
void SideChooser::measure(int j, int rows) {
  const auto first = has_jump_.begin() + std::max(j - kVoteRadius, 0);
  const auto last = has_jump_.begin() + std::min(j + kVoteRadius + 1, rows);
  if (std::find(first, last, true) == last) return;
  for (int c = 0; c < 3; ++c) {
    float* const color = color_[c].row(j) + kVoteRadius;
    if (!is_inside(j)) {
      std::fill_n(color, width_, kNoPixel);
      continue;
    }
    const std::uint32_t* const packed = views_.pixels.view(before_.view).row(begin_ + j);
    for (int x = 0; x < width_; ++x) {
      color[x] = packed_sample(packed[x], c);
    }
  }
  if (!is_inside(j)) return;
  add_residuals(j, 0, before_.disparity.row(begin_ + j) + kReach);
  add_residuals(j, 1, sides_[Far].row(j));
  add_residuals(j, 2, sides_[Near].row(j));
}

void SideChooser::add_residuals(int j, int of, const float* disparity) {
  const float* const measured = residuals_.row(begin_ + j, disparity);
  float* const residual = residual_[of].row(j) + kVoteRadius;
  for (int x = 0; x < width_; ++x) residual[x] = std::min(measured[x], cap_);
}

void SideChooser::choose(int j, float* disparity, float* confidence) {
  for (int k = 0; k < kVoteRows; ++k) {
    const int from = j + k - kVoteRadius;
    for (int i = 0; i < 3; ++i) {
      row_.residual[i][k] = residual_[i].row(from) + kVoteRadius;
      row_.color[i][k] = color_[i].row(from) + kVoteRadius;
    }
  }
  row_.far = sides_[Far].row(j);
  row_.near = sides_[Near].row(j);
  row_.far_confidence = sides_[FarConfidence].row(j);
  row_.near_confidence = sides_[NearConfidence].row(j);
  // The kernel works on whole registers, rows of the view end where the next begin.
  row_.disparity = own_[0].data();
  row_.confidence = own_[1].data();
  std::copy_n(disparity, width_, row_.disparity);
  std::copy_n(confidence, width_, row_.confidence);
  kernel_.choose(row_);
  std::copy_n(row_.disparity, width_, disparity);
  std::copy_n(row_.confidence, width_, confidence);
}

}  // namespace

void choose_sides(const PackedViews& views, Estimate& estimate, const Progress& progress) {
  choose_sides(views, residual_noise(views, estimate.field.disparity), estimate.field.disparity,
               estimate.confidence, progress);
}

void choose_sides(const PackedViews& views, float variance, ViewStack<float>& disparity,
                  ViewStack<float>& confidence, const Progress& progress) {
  const GridShape grid = disparity.grid();
  const int bands = (disparity.height() + kBandRows - 1) / kBandRows;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i, disparity.first());
    const ImageView<float> d = disparity.view(view), r = confidence.view(view);
    const Before before{view, padded(d), padded(r)};
    const double count = grid.count();
    parallel_for_workers(bands, progress.part(i / count, (i + 1) / count), [&] {
      return [&, chooser = SideChooser(views, variance, before)](int band) mutable {
        const int y = band * kBandRows;
        chooser.decide(y, std::min(y + kBandRows, d.height), d, r);
      };
    });
  }
}

}  // namespace episcope
