// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/line_residuals.h"

#include "engine/core/array/quantile.h"
#include "engine/core/parallel/isa.h"

#include <algorithm>
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

}  // namespace

LineResiduals::LineResiduals(const PackedViews& views)
    : views_(views),
      kernel_(EPISCOPE_CHOOSE_KERNEL(best_isa(), kResidualKernel)),
      own_(views.pixels.width() + kResidualSlack),
      slopes_(own_.size()),
      residual_(own_.size()) {}

void LineResiduals::begin(ViewIndex view) {
  view_ = view;
  row_ = around(views_, view);
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

}  // namespace episcope
