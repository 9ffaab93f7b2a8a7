// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/line_check.h"

#include "engine/core/parallel/parallel.h"
#include "engine/cuda/line_check/line_check.h"
#include "engine/disparity/common/box_mean.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/epi/line_residuals.h"
#include "engine/disparity/epi/line_trust_kernel.h"
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

// Rows of packed samples, each with the nearest neighbours before and after it in place of those
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
