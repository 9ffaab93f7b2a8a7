// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/even_brightness.h"

#include "engine/core/indices.h"
#include "engine/core/parallel.h"
#include "engine/core/view_gain.h"
#include "engine/core/view_stack.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace episcope {
namespace {

// Means of views that differ by less speak for gains that do, too.
constexpr double kNotableMeans = 0.01;
constexpr int kPixelStep = 8;  // of the means

bool is_kept(const LightField& lf) {
  const ParameterValue* const kept = lf.info().reading.find(kKeepBrightness);
  return kept != nullptr && std::get<bool>(*kept);
}

template <class T>
double mean_of(const ViewStack<T>& stack, ViewIndex index) {
  const auto view = stack.view(index);
  double sum = 0;
  int count = 0;
  for (int y = kPixelStep / 2; y < view.height; y += kPixelStep) {
    for (int x = kPixelStep / 2; x < view.width; x += kPixelStep, ++count) {
      for (int c = 0; c < view.channels; ++c) sum += view.at(y, x, c);
    }
  }
  return count > 0 ? sum / count : 0;
}

// A first look, at one of 64 pixels.
bool have_notable_means(const LightField& lf, const Progress& progress) {
  return std::visit(
      [&](const auto& stack) {
        const double center = mean_of(stack, lf.center());
        for (int i = 0; i < lf.grid().count(); ++i) {
          progress.check();
          // The disk reads while the view before is looked at.
          if (i + 1 < lf.grid().count()) lf.fetch_samples(lf.grid().view_at(i + 1), 0, lf.height());
          const double mean = mean_of(stack, lf.grid().view_at(i));
          forget_view(stack, lf.grid().view_at(i));
          if (!(std::abs(mean - center) <= kNotableMeans * center)) return true;
        }
        return false;
      },
      lf.samples());
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
  if (lf.grid().count() < 2 || is_kept(lf) || !have_notable_means(lf, progress)) return {};
  const auto blocks = has_many_views(lf.grid()) ? GainBlocks::OneOfFour : GainBlocks::All;
  const ViewGains gains =
      measure_view_gains(lf.samples(), lf.valid(), progress.part(0, 0.4), blocks);
  lf.forget_samples();
  const double difference = std::abs(gains.of(gains.most_different()) - 1);
  if (!(difference > kNotableGain)) return {};
  LightField::Samples samples = std::visit(
      [&](const auto& stack) {
        return LightField::Samples(copied(stack, progress.part(0.4, 0.7)));
      },
      lf.samples());
  divide_by_gains(samples, gains, progress.part(0.7, 1));
  return EvenLightField{LightField(std::move(samples), lf.info(), lf.valid().clone()),
                        fmt::format("brightness of the views, which differs by up to {:.1f} %, was "
                                    "evened out",
                                    100 * difference)};
}

}  // namespace

std::shared_ptr<const std::optional<EvenLightField>> even_brightness(const LightField& lf,
                                                                     const Progress& progress) {
  return lf.beside().get<std::optional<EvenLightField>>([&] {
    std::optional<EvenLightField> even = make_even(lf, progress);
    const bool is_in_memory = even && !even->light_field.is_on_disk();
    const std::size_t bytes = is_in_memory ? even->light_field.byte_size() : 0;
    return std::pair(std::move(even), bytes);
  });
}

}  // namespace episcope
