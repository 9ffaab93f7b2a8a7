// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/replace_occluded.h"

#include "engine/core/parallel.h"
#include "engine/cuda/line_check.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/line_check.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

// One view that lines of another reach, by `steps` in its row or column of the grid.
struct Reached {
  ImageView<const float> disparity, confidence;
  bool vertical = false;
  float steps = 0;
};

std::vector<Reached> views_reached(const ViewStack<float>& disparity,
                                   const ViewStack<float>& confidence, ViewIndex from) {
  std::vector<Reached> reached;
  for (int k = -kOccludedReach; k <= kOccludedReach; ++k) {
    if (k == 0) continue;
    for (const bool vertical : {false, true}) {
      const ViewIndex view{from.v + (vertical ? k : 0), from.u + (vertical ? 0 : k)};
      if (!disparity.contains(view)) continue;
      reached.push_back(
          {disparity.view(view), confidence.view(view), vertical, static_cast<float>(k)});
    }
  }
  return reached;
}

// What lies farther than a ray at the ends of its line.
struct Farther {
  std::array<float, 4 * kOccludedReach> disparity{};
  int count = 0;

  float median() {
    const auto middle = disparity.begin() + count / 2;
    std::nth_element(disparity.begin(), middle, disparity.begin() + count);
    return *middle;
  }
};

void look_along(const Reached& view, PixelIndex p, float disparity, float confidence,
                Farther& farther) {
  const int last = (view.vertical ? view.disparity.height : view.disparity.width) - 1;
  const float at = static_cast<float>(view.vertical ? p.y : p.x) - disparity * view.steps;
  if (!(at >= 0 && at <= static_cast<float>(last))) return;
  const int nearest = static_cast<int>(at + 0.5F);
  const int y = view.vertical ? nearest : p.y, x = view.vertical ? p.x : nearest;
  const float met = view.disparity.at(y, x);
  if (met < disparity - kOccludedFarther && view.confidence.at(y, x) >= confidence) {
    farther.disparity[farther.count++] = met;
  }
}

// Decides rows of one view after the other; one per thread.
class Replacer {
 public:
  Replacer(const PackedViews& views, const ViewStack<float>& disparity,
           const ViewStack<float>& confidence, float noise)
      : disparity_(disparity),
        confidence_(confidence),
        tolerance_(kOccludedTolerance * noise),
        residuals_(views),
        farther_(disparity.width()),
        residual_(disparity.width()) {}

  void begin(ViewIndex view) {
    view_ = view;
    reached_ = views_reached(disparity_, confidence_, view);
    least_views_ =
        std::max(kOccludedMinViews, static_cast<int>(reached_.size()) / kOccludedMinShare);
    residuals_.begin(view);
  }

  // Returns the number of rays changed.
  long replace(int y, float* out) {
    const float* const own = disparity_.view(view_).row(y);
    if (!find_farther(y)) return 0;
    std::copy_n(residuals_.row(y, farther_.data()), residual_.size(), residual_.data());
    const float* const own_residual = residuals_.row(y, own);
    long changed = 0;
    for (std::size_t x = 0; x < farther_.size(); ++x) {
      if (farther_[x] == own[x] || !(residual_[x] <= own_residual[x] + tolerance_)) continue;
      out[x] = farther_[x];
      ++changed;
    }
    return changed;
  }

 private:
  // What each ray of a row could be instead; its own disparity where nothing. Whether there is any.
  bool find_farther(int y) {
    const float* const own = disparity_.view(view_).row(y);
    const float* const confidence = confidence_.view(view_).row(y);
    bool has_any = false;
    for (int x = 0; x < disparity_.width(); ++x) {
      Farther farther;
      for (const Reached& view : reached_) {
        look_along(view, {y, x}, own[x], confidence[x], farther);
      }
      const bool is_seen_through = farther.count >= least_views_;
      farther_[x] = is_seen_through ? farther.median() : own[x];
      has_any = has_any || is_seen_through;
    }
    return has_any;
  }

  const ViewStack<float>&disparity_, &confidence_;
  float tolerance_;
  LineResiduals residuals_;
  std::vector<float> farther_, residual_;
  std::vector<Reached> reached_;
  int least_views_ = kOccludedMinViews;
  ViewIndex view_;
};

}  // namespace

float replacement_noise(const PackedViews& views, ViewIndex center,
                        ImageView<const float> disparity) {
  return residual_noise(views, center, disparity) + kMinDifference * kMinDifference;
}

long replace_occluded(const PackedViews& views, float noise, const ViewStack<float>& before,
                      const ViewStack<float>& confidence, ViewStack<float>& disparity,
                      const Progress& progress) {
  std::vector<long> changed(disparity.grid().count());
  parallel_for_workers(disparity.grid().count(), progress, [&] {
    return [&, replacer = Replacer(views, before, confidence, noise)](int i) mutable {
      const ViewIndex view = disparity.view_at(i);
      replacer.begin(view);
      for (int y = 0; y < before.height(); ++y) {
        if (y % 16 == 0) progress.check();
        changed[i] += replacer.replace(y, disparity.view(view).row(y));
      }
    };
  });
  return std::accumulate(changed.begin(), changed.end(), 0L);
}

long replace_occluded(const PackedViews& views, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress) {
  const ViewStack<float> before = disparity.clone();
  const float noise = residual_noise(views, before) + kMinDifference * kMinDifference;
  return replace_occluded(views, noise, before, confidence, disparity, progress);
}

void replace_occluded(const LightField& lf, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress, Device device) {
  if (device == Device::Cuda) return cuda::replace_occluded(lf, disparity, confidence, progress);
  replace_occluded(pack_views(lf, progress.part(0, 0.25)), disparity, confidence,
                   progress.part(0.25, 1));
}

}  // namespace episcope
