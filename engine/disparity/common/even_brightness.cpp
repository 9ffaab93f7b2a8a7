// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/even_brightness.h"

#include "engine/core/light_field/many_views.h"
#include "engine/core/light_field/view_gain.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>
#include <variant>

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
bool have_notable_means(const LightField& lf) {
  return std::visit(
      [&](const auto& stack) {
        const double center = mean_of(stack, lf.center());
        for (int i = 0; i < lf.grid().count(); ++i) {
          const double mean = mean_of(stack, lf.grid().view_at(i));
          if (!(std::abs(mean - center) <= kNotableMeans * center)) return true;
        }
        return false;
      },
      lf.samples());
}

std::optional<EvenLightField> make_even(const LightField& lf, const Progress& progress) {
  if (lf.grid().count() < 2 || lf.is_on_disk() || is_kept(lf) || !have_notable_means(lf)) return {};
  const auto blocks = has_many_views(lf.grid()) ? GainBlocks::OneOfFour : GainBlocks::All;
  const ViewGains gains = measure_view_gains(lf.samples(), lf.valid(), progress, blocks);
  const double difference = std::abs(gains.of(gains.most_different()) - 1);
  if (!(difference > kNotableGain)) return {};
  LightField::Samples samples = std::visit(
      [](const auto& stack) { return LightField::Samples(stack.clone()); }, lf.samples());
  divide_by_gains(samples, gains, progress);
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
    const std::size_t bytes = even ? even->light_field.byte_size() : 0;
    return std::pair(std::move(even), bytes);
  });
}

Estimator seeing_even_brightness(Estimator estimator) {
  ++estimator.info.revision;  // results of uneven views are others than the method's own
  estimator.run = [run = std::move(estimator.run)](
                      const LightField& light_field, const ParameterSet& values,
                      const RunOptions& options, const Progress& progress) {
    const auto kept = even_brightness(light_field, progress.limited_to(options.threads));
    const std::optional<EvenLightField>& even = *kept;
    Estimate estimate = run(even ? even->light_field : light_field, values, options, progress);
    if (even) estimate.notes.push_back(even->note);
    return estimate;
  };
  if (!estimator.in_blocks) return estimator;
  estimator.in_blocks = [blocks = std::move(estimator.in_blocks)](
                            const LightField& light_field, const ParameterSet& values,
                            const RunOptions& options, const Progress& progress) {
    const auto even = even_brightness(light_field, progress.limited_to(options.threads));
    if (!*even) return blocks(light_field, values, options, progress);
    BlockwiseRun run = blocks((*even)->light_field, values, options, progress);
    run.provenance.notes.push_back((*even)->note);
    // The run refers to its light field, which lives as long as this.
    run.notes = [even, notes = std::move(run.notes)](const BlockProgress& end) {
      return notes ? notes(end) : std::vector<std::string>();
    };
    return run;
  };
  return estimator;
}

}  // namespace episcope
