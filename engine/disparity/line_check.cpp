// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/line_check.h"

#include "engine/core/isa.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/kernels/shared_constants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace episcope {
namespace {

LineArm arm_of(const PackedViews& views, ViewIndex from, ViewIndex way) {
  LineArm arm;
  arm.vertical = way.v != 0;
  arm.step = -(way.u + way.v);  // a point moves by −d per step of u or v
  for (int k = 1; k <= kMaxArmViews; ++k) {
    const ViewIndex view{from.v + k * way.v, from.u + k * way.u};
    if (!views.pixels.contains(view)) break;
    arm.views[arm.count++] = views.pixels.view(view).data;
  }
  return arm;
}

ResidualRow residual_row_at(const PackedViews& views, ViewIndex view) {
  ResidualRow row;
  for (const ViewIndex way :
       {ViewIndex{0, 1}, ViewIndex{0, -1}, ViewIndex{1, 0}, ViewIndex{-1, 0}}) {
    const LineArm arm = arm_of(views, view, way);
    if (arm.count > 0) row.arms[row.arm_count++] = arm;
  }
  // One view that agrees may do so by chance; small grids have no more.
  const int longest = std::max(views.pixels.grid().u, views.pixels.grid().v);
  row.min_views = std::clamp(longest / 2, 1, 2);
  row.height = views.pixels.height();
  row.width = views.pixels.width();
  row.has_invalid = views.has_invalid;
  return row;
}

constexpr int kChoiceBandRows = 48;

// The rows of a map with their ends repeated, so that all neighbors can be read.
Image<float> padded_map(ImageView<const float> map) {
  Image<float> wide(map.height, map.width + 2 * kSideReach + kSideSlack);
  for (int y = 0; y < map.height; ++y) {
    const float* const from = map.row(y);
    float* const to = wide.row(y);
    std::fill_n(to, kSideReach, from[0]);
    std::copy_n(from, map.width, to + kSideReach);
    std::fill(to + kSideReach + map.width, to + wide.width(), from[map.width - 1]);
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

  // Rows of the view from `begin` on, at most kChoiceBandRows.
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
  static constexpr int kRows = kChoiceBandRows + 2 * kVoteRadius;

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
      cap_(kSideCap * (variance + kMinDifference * kMinDifference)),
      residuals_(views) {
  const int wide = width_ + 2 * kVoteRadius + kSideSlack;
  for (Image<float>& side : sides_) side = Image<float>(kRows, width_ + kSideSlack);
  for (Image<float>& residual : residual_) residual = Image<float>(kRows, wide);
  for (Image<float>& color : color_) color = Image<float>(kRows, wide, 1, kNoPixel);
  for (std::vector<float>& own : own_) own.resize(width_ + kSideSlack);
  row_.width = width_;
  row_.sharpness = 1 / (8 * (kSideColorScale * kSideColorScale + 2 * variance));
  row_.least_step = kLeastSideStep;
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
  NeighborRow row;
  row.width = width_;
  for (int k = 0; k < kSideNeighbors; ++k) {
    const int y = std::clamp(begin_ + j + kSideOffsets.at[k][0], 0, height_ - 1);
    const int x = kSideReach + kSideOffsets.at[k][1];
    row.disparity[k] = before_.disparity.row(y) + x;
    row.confidence[k] = before_.confidence.row(y) + x;
  }
  row.far_trust = kFarTrust;
  row.own_disparity = before_.disparity.row(begin_ + j) + kSideReach;
  row.own_confidence = before_.confidence.row(begin_ + j) + kSideReach;
  row.far = sides_[Far].row(j);
  row.near = sides_[Near].row(j);
  row.far_confidence = sides_[FarConfidence].row(j);
  row.near_confidence = sides_[NearConfidence].row(j);
  kernel_.gather(row);
  for (int x = 0; x < width_; ++x) {
    const float own = row.own_disparity[x];
    has_jump_[j] |= own - row.far[x] > kLeastSideStep || row.near[x] - own > kLeastSideStep;
  }
}

// Residuals and colors of a row, if a row that it votes on has a jump.
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
  add_residuals(j, 0, before_.disparity.row(begin_ + j) + kSideReach);
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

// Rows of packed samples, each with the nearest neighbors before and after it in place of those
// beyond the border: see GradientRow.
class MirroredRows {
 public:
  explicit MirroredRows(int width) : width_(width) {
    for (auto& row : rows_) row.resize(width + 2 * kTrustSlack);
  }

  // Reads row y of a view in place of row y − 3.
  void read(const ImageView<const std::uint32_t>& view, int y) {
    std::uint32_t* const row = rows_[(y + 3) % 3].data() + kTrustSlack;
    const int mirrored = y < 0 ? -y : y >= view.height ? 2 * (view.height - 1) - y : y;
    std::copy_n(view.row(std::clamp(mirrored, 0, view.height - 1)), width_, row);
    row[-1] = row[std::min(1, width_ - 1)];
    row[width_] = row[std::max(width_ - 2, 0)];
  }
  [[nodiscard]] const std::uint32_t* row(int y) const {
    return rows_[(y + 3) % 3].data() + kTrustSlack;
  }

 private:
  int width_;
  std::array<std::vector<std::uint32_t>, 3> rows_;
};

// Squared gradients of one view after the other, and their means over windows; one per thread.
class Texture {
 public:
  Texture(int height, int width)
      : kernel_(EPISCOPE_CHOOSE_KERNEL(best_isa(), kTrustKernel)),
        mean_(height, width),
        own_(height, width),
        rows_(width),
        scratch_(2, width + kTrustSlack),
        column_(width),
        window_(width + kTrustSlack) {}

  void begin(const ImageView<const std::uint32_t>& view) {
    rows_.read(view, -1);
    rows_.read(view, 0);
    for (int y = 0; y < view.height; ++y) {
      rows_.read(view, y + 1);
      kernel_.gradients({rows_.row(y - 1), rows_.row(y), rows_.row(y + 1), view.width,
                         scratch_.row(0), scratch_.row(1)});
      std::copy_n(scratch_.row(0), view.width, mean_.row(y));
      std::copy_n(scratch_.row(1), view.width, own_.row(y));
    }
  }

  // Squared gradients of a row, and their means; valid until the next call, slack behind.
  const float* own(int y) {
    std::copy_n(own_.row(y), own_.width(), scratch_.row(1));
    return scratch_.row(1);
  }
  const float* window(int y) {
    window_mean_row(mean_, y, kTextureRadius, column_.data(), window_.data());
    return window_.data();
  }

 private:
  const TrustKernel& kernel_;
  Image<float> mean_, own_;
  MirroredRows rows_;
  Image<float> scratch_;
  std::vector<float> column_, window_;
};

// What multiplies the confidence of one view after the other; one per thread.
class Trust {
 public:
  Trust(const PackedViews& views, const ViewStack<float>& disparity, float variance)
      : views_(views),
        variance_(variance),
        disparity_(disparity),
        residuals_(views),
        texture_(views.pixels.height(), views.pixels.width()),
        trust_(views.pixels.width() + kTrustSlack) {}

  void begin(ViewIndex view) {
    view_ = view;
    residuals_.begin(view);
    texture_.begin(views_.pixels.view(view));
  }

  // Valid until the next call.
  const float* row(int y) {
    EPISCOPE_CHOOSE_KERNEL(best_isa(), kTrustKernel)
        .trust({residuals_.row(y, disparity_.view(view_).row(y)), texture_.own(y),
                texture_.window(y), views_.pixels.width(), variance_,
                kMinDifference * kMinDifference + variance_, kTextureGain, trust_.data()});
    return trust_.data();
  }

 private:
  const PackedViews& views_;
  float variance_;
  const ViewStack<float>& disparity_;
  LineResiduals residuals_;
  Texture texture_;
  ViewIndex view_;
  std::vector<float> trust_;
};

}  // namespace

LineResiduals::LineResiduals(const PackedViews& views)
    : views_(views),
      kernel_(EPISCOPE_CHOOSE_KERNEL(best_isa(), kResidualKernel)),
      own_(views.pixels.width() + kResidualSlack),
      slopes_(own_.size()),
      residual_(own_.size()) {}

void LineResiduals::begin(ViewIndex view) {
  view_ = view;
  row_ = residual_row_at(views_, view);
  row_.own = own_.data();
  row_.disparity = slopes_.data();
  row_.residual = residual_.data();
}

const float* LineResiduals::row(int y, const float* disparity) {
  std::copy_n(views_.pixels.view(view_).row(y), row_.width, own_.data());
  std::copy_n(disparity, row_.width, slopes_.data());
  row_.y = y;
  kernel_.row(row_);
  return residual_.data();
}

float residual_noise(const PackedViews& views, const ViewStack<float>& disparity) {
  const ViewIndex center = views.pixels.grid().center();
  return residual_noise(views, center, disparity.view(center));
}

float residual_noise(const PackedViews& views, ViewIndex view, ImageView<const float> disparity) {
  LineResiduals residuals(views);
  residuals.begin(view);
  std::vector<float> all;
  for (int y = 0; y < views.pixels.height(); ++y) {
    const float* const row = residuals.row(y, disparity.row(y));
    std::copy_if(row, row + views.pixels.width(), std::back_inserter(all),
                 [](float value) { return std::isfinite(value); });
  }
  return all.empty() ? 0 : quantile(all, 0.5);
}

void choose_sides(const PackedViews& views, Estimate& estimate, const Progress& progress) {
  choose_sides(views, residual_noise(views, estimate.field.disparity), estimate.field.disparity,
               estimate.confidence, progress);
}

void choose_sides(const PackedViews& views, float variance, ViewStack<float>& disparity,
                  ViewStack<float>& confidence, const Progress& progress) {
  const GridShape grid = disparity.grid();
  const int bands = (disparity.height() + kChoiceBandRows - 1) / kChoiceBandRows;
  for (int i = 0; i < grid.count(); ++i) {
    const ViewIndex view = grid.view_at(i, disparity.first());
    const ImageView<float> d = disparity.view(view), r = confidence.view(view);
    const Before before{view, padded_map(d), padded_map(r)};
    const double count = grid.count();
    parallel_for_workers(bands, progress.part(i / count, (i + 1) / count), [&] {
      return [&, chooser = SideChooser(views, variance, before)](int band) mutable {
        const int y = band * kChoiceBandRows;
        chooser.decide(y, std::min(y + kChoiceBandRows, d.height), d, r);
      };
    });
  }
}

Schema<LineCheck> line_check_schema() {
  return Schema<LineCheck>()
      .flag("choose_sides", &LineCheck::chooses_sides,
            {"Choose sides",
             "Near a jump of disparity, give each pixel the disparity of the side whose lines it "
             "fits, in half of the views at least"})
      .flag("check_lines", &LineCheck::is_on,
            {"Check lines",
             "Reduce the confidence of estimates where other views show a different color along "
             "the line, or where the texture belongs to a neighboring pixel"});
}

void check_lines(const LightField& lf, const LineCheck& check, Estimate& estimate,
                 const Progress& progress, Device device) {
  if (!check.does_anything()) return;
  if (device == Device::Cuda) {
    return cuda::check_lines(lf, {check.chooses_sides, check.is_on}, estimate.field.disparity,
                             estimate.confidence, progress);
  }
  check_lines(pack_views(lf, progress.part(0, 0.1)), check, estimate, progress.part(0.1, 1));
}

void check_lines(const PackedViews& views, const LineCheck& check, Estimate& estimate,
                 const Progress& progress) {
  if (!check.does_anything()) return;
  progress.step("checking lines");
  if (check.chooses_sides) choose_sides(views, estimate, progress.part(0, 0.7));
  if (check.is_on) reduce_confidence(views, estimate, progress.part(0.7, 1));
}

std::vector<double> line_check_noise(const LightField& lf, const LineCheck& check, BlockMaps center,
                                     const Progress& progress) {
  std::vector<double> noise(2);
  if (!check.does_anything()) return noise;
  ViewStack<float>& disparity = center.field.disparity;
  const ViewIndex view = disparity.first();
  const PackedViews packed = pack_around(lf, {view, {1, 1}}, kMaxArmViews, progress);
  noise[0] = residual_noise(packed, view, disparity.view(view));
  if (check.chooses_sides) {
    choose_sides(packed, static_cast<float>(noise[0]), disparity, center.confidence, progress);
  }
  noise[1] = residual_noise(packed, view, disparity.view(view));
  return noise;
}

void check_lines(const PackedViews& packed, const LineCheck& check,
                 const std::vector<double>& noise, BlockMaps& maps, const Progress& progress) {
  if (check.chooses_sides) {
    choose_sides(packed, static_cast<float>(noise[0]), maps.field.disparity, maps.confidence,
                 progress.part(0, 0.7));
  }
  if (check.is_on) {
    reduce_confidence(packed, static_cast<float>(noise[1]), maps.field.disparity, maps.confidence,
                      progress.part(0.7, 1));
  }
}

void reduce_confidence(const LightField& lf, Estimate& estimate, const Progress& progress) {
  reduce_confidence(pack_views(lf, progress.part(0, 0.2)), estimate, progress.part(0.2, 1));
}

void reduce_confidence(const PackedViews& views, Estimate& estimate, const Progress& progress) {
  const ViewStack<float>& disparity = estimate.field.disparity;
  reduce_confidence(views, residual_noise(views, disparity), disparity, estimate.confidence,
                    progress);
}

void reduce_confidence(const PackedViews& views, float variance, const ViewStack<float>& disparity,
                       ViewStack<float>& confidence_maps, const Progress& progress) {
  const GridShape grid = disparity.grid();
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, trust = Trust(views, disparity, variance)](int i) mutable {
      const ViewIndex view = grid.view_at(i, disparity.first());
      trust.begin(view);
      const ImageView<float> confidence = confidence_maps.view(view);
      for (int y = 0; y < confidence.height; ++y) {
        if (y % 16 == 0) progress.check();
        const float* const factors = trust.row(y);
        float* const row = confidence.row(y);
        for (int x = 0; x < confidence.width; ++x) row[x] *= factors[x];
      }
    };
  });
}

}  // namespace episcope
