// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/line_check.h"

#include "engine/core/array/quantile.h"
#include "engine/core/parallel/isa.h"
#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/box_mean.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/epi/line_residual_kernel.h"
#include "engine/disparity/epi/line_trust_kernel.h"

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

ResidualRow around(const PackedViews& views, ViewIndex view) {
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

// Computes rows of residuals of one view after the other; one per thread.
class Residuals {
 public:
  Residuals(const PackedViews& views, const ViewStack<float>& disparity)
      : views_(views),
        disparity_(disparity),
        kernel_(EPISCOPE_CHOOSE_KERNEL(best_isa(), kResidualKernel)),
        own_(views.pixels.width() + kResidualSlack),
        slopes_(own_.size()),
        residual_(own_.size()) {}

  void begin(ViewIndex view) {
    view_ = view;
    row_ = around(views_, view);
    row_.own = own_.data();
    row_.disparity = slopes_.data();
    row_.residual = residual_.data();
  }

  // `width` residuals, valid until the next call.
  const float* row(int y) {
    std::copy_n(views_.pixels.view(view_).row(y), row_.width, own_.data());
    std::copy_n(disparity_.view(view_).row(y), row_.width, slopes_.data());
    row_.y = y;
    kernel_.row(row_);
    return residual_.data();
  }

 private:
  const PackedViews& views_;
  const ViewStack<float>& disparity_;
  const ResidualKernel& kernel_;
  std::vector<std::uint32_t> own_;
  std::vector<float> slopes_, residual_;
  ViewIndex view_;
  ResidualRow row_;
};

// Median residual of the centre view.
float noise_variance(const PackedViews& views, const ViewStack<float>& disparity) {
  Residuals residuals(views, disparity);
  residuals.begin(views.pixels.grid().center());
  std::vector<float> all;
  for (int y = 0; y < views.pixels.height(); ++y) {
    const float* const row = residuals.row(y);
    std::copy_if(row, row + views.pixels.width(), std::back_inserter(all),
                 [](float value) { return std::isfinite(value); });
  }
  return all.empty() ? 0 : quantile(all, 0.5);
}

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
    const int width = mean_.width();
    const auto rows = static_cast<float>(sum_rows(mean_, y, kTextureRadius, column_.data()));
    box_mean_row(column_.data(), width, kTextureRadius, window_.data());
    for (int x = 0; x < width; ++x) window_[x] /= rows;
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
        residuals_(views, disparity),
        texture_(views.pixels.height(), views.pixels.width()),
        trust_(views.pixels.width() + kTrustSlack) {}

  void begin(ViewIndex view) {
    residuals_.begin(view);
    texture_.begin(views_.pixels.view(view));
  }

  // Valid until the next call.
  const float* row(int y) {
    EPISCOPE_CHOOSE_KERNEL(best_isa(), kTrustKernel)
        .trust({residuals_.row(y), texture_.own(y), texture_.window(y), views_.pixels.width(),
                variance_, kMinDifference * kMinDifference + variance_, kTextureGain,
                trust_.data()});
    return trust_.data();
  }

 private:
  const PackedViews& views_;
  float variance_;
  Residuals residuals_;
  Texture texture_;
  std::vector<float> trust_;
};

}  // namespace

Schema<LineCheck> line_check_schema() {
  return Schema<LineCheck>().flag(
      "check_lines", &LineCheck::is_on,
      {"Check lines",
       "Reduce the confidence of estimates where other views show a different colour along the "
       "line, or where the texture belongs to a neighbouring pixel"});
}

void reduce_confidence(const LightField& lf, Estimate& estimate, const Progress& progress) {
  reduce_confidence(pack_views(lf, progress.part(0, 0.2)), estimate, progress.part(0.2, 1));
}

void reduce_confidence(const PackedViews& views, Estimate& estimate, const Progress& progress) {
  const ViewStack<float>& disparity = estimate.field.disparity;
  const float variance = noise_variance(views, disparity);
  const GridShape grid = disparity.grid();
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, trust = Trust(views, disparity, variance)](int i) mutable {
      const ViewIndex view = grid.view_at(i, disparity.first());
      trust.begin(view);
      const ImageView<float> confidence = estimate.confidence.view(view);
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
