// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/even_views.h"

#include "engine/core/parallel.h"
#include "engine/core/photometric_correction.h"
#include "engine/core/view_gain.h"
#include "engine/core/view_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

namespace episcope {
namespace {

bool keeps_brightness(const LightField& lf) {
  const ParameterValue* const kept = lf.info().reading.find(kKeepBrightness);
  return kept != nullptr && std::get<bool>(*kept);
}

// In memory or on disk, as it fits.
template <class T>
ViewStack<T> copied(const ViewStack<T>& stack, const Progress& progress) {
  ViewStack<T> copy(stack.grid(), stack.height(), stack.width(), stack.channels());
  parallel_for(stack.grid().count(), progress, [&](int i) {
    const ViewIndex view = stack.grid().view_at(i);
    std::copy_n(stack.view(view).data, stack.view_size(), copy.view(view).data);
    forget_view(stack, view);
    forget_view(copy, view);
  });
  return copy;
}

std::optional<EvenLightField> make_even(const LightField& lf, const Progress& progress) {
  if (lf.grid().count() < 2 || keeps_brightness(lf) || !have_notable_means(lf, progress)) return {};
  const auto blocks = has_many_views(lf.grid()) ? GainBlocks::OneOfFour : GainBlocks::All;
  const PhotometricCorrection correction =
      measure_view_gains(lf.samples(), lf.valid(), progress.part(0, 0.4), blocks);
  lf.forget_samples();
  if (!correction.is_notable()) return {};
  LightField::Samples samples = std::visit(
      [&](const auto& stack) {
        return LightField::Samples(copied(stack, progress.part(0.4, 0.7)));
      },
      lf.samples());
  divide_by_gains(samples, correction, progress.part(0.7, 1));
  const double difference = std::abs(correction.of(correction.most_different()) - 1);
  return EvenLightField{LightField(std::move(samples), lf.info(), lf.valid().clone()),
                        fmt::format("brightness of the views, which differs by up to {:.1f} %, was "
                                    "evened out",
                                    100 * difference)};
}

}  // namespace

std::shared_ptr<const EvenLightField> EvenViews::of(const LightField& lf,
                                                    const Progress& progress) {
  const std::lock_guard lock(lock_);
  if (measured_ == lf.identity()) return even_;
  std::optional<EvenLightField> made = make_even(lf, progress);
  even_ = made ? std::make_shared<const EvenLightField>(*std::move(made)) : nullptr;
  const bool is_in_memory = even_ && !even_->light_field.is_on_disk();
  bytes_ = is_in_memory ? even_->light_field.byte_size() : 0;
  measured_ = lf.identity();
  return even_;
}

}  // namespace episcope
