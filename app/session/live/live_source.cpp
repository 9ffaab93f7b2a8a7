// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/live/live_source.h"

#include "app/session/live/live_part.h"
#include "engine/core/light_field/cropped.h"
#include "engine/disparity/common/disparity_range.h"
#include "engine/disparity/common/smaller_views.h"

#include <algorithm>
#include <memory>

namespace episcope {
namespace {

bool is_whole(const PixelRect& part, const LightField& lf) {
  return part == PixelRect{0, 0, lf.height(), lf.width()};
}

}  // namespace

Interval LiveSource::range(const IntervalOrAuto& wanted, const Progress& progress) {
  if (range_source(*light_field_, wanted) != RangeSource::Found) {
    return search_range(*light_field_, wanted, progress);
  }
  if (!found_) found_ = search_range(*light_field_, wanted, progress);
  return *found_;
}

LightFieldPtr LiveSource::full(const PixelRect& part, const Progress& progress) {
  if (is_whole(part, *light_field_)) {
    part_.reset();
    return light_field_;
  }
  if (!part_ || cut_ != part) {
    part_ = std::make_shared<const LightField>(cropped(*light_field_, part, progress));
    cut_ = part;
  }
  return part_;
}

LightFieldPtr LiveSource::coarse(const PixelRect& part, const Progress& progress) {
  if (!smaller_) {
    LightFieldInfo info = light_field_->info();
    info.disparity_range.reset();
    smaller_ = std::make_shared<const LightField>(
        smaller_views(*light_field_, kLiveFactor, progress.part(0, 0.8), ReducedViews::All),
        std::move(info));
  }
  if (is_whole(part, *light_field_)) return smaller_;
  const auto ceiled = [](int n, int most) {
    return std::min((n + kLiveFactor - 1) / kLiveFactor, most);
  };
  const PixelRect inside{part.y0 / kLiveFactor, part.x0 / kLiveFactor,
                         ceiled(part.y1, smaller_->height()), ceiled(part.x1, smaller_->width())};
  return std::make_shared<const LightField>(cropped(*smaller_, inside, progress.part(0.8, 1)));
}

}  // namespace episcope
