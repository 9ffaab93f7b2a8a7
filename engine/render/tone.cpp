// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/tone.h"

#include "engine/core/numbers.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::render {
namespace {

constexpr double kDarkest = 0.005;  // quantiles
constexpr double kBrightest = 0.995;
constexpr double kDark = 0.12;    // a median below it
constexpr double kMiddle = 0.35;  // where the median of a dark view is lifted to

// Samples of all channels that show something, in [0, 1].
std::vector<float> shown_samples(const LightField& light_field, ViewIndex view) {
  const int channels = light_field.channels();
  const int width = light_field.width();
  std::vector<float> row(static_cast<std::size_t>(width) * channels);
  std::vector<float> samples;
  samples.reserve(row.size() * light_field.height());
  const auto valid = light_field.valid_of(view);
  for (int y = 0; y < light_field.height(); ++y) {
    light_field.read_row(view, y, 0, width, row.data());
    for (int x = 0; x < width; ++x) {
      if (!valid.empty() && valid.at(y, x) == 0) continue;
      for (int c = 0; c < channels; ++c) {
        const float sample = row[static_cast<std::size_t>(x) * channels + c];
        if (std::isfinite(sample)) samples.push_back(std::clamp(sample, 0.0F, 1.0F));
      }
    }
  }
  return samples;
}

}  // namespace

Tone automatic_tone(const LightField& light_field, ViewIndex view) {
  std::vector<float> samples = shown_samples(light_field, view);
  if (samples.empty()) return {};
  Tone tone;
  tone.black = std::min<double>(quantile(samples, kDarkest), kBlackRange.max);
  const auto stretched = [&tone](double sample) {
    return (sample - tone.black) / (1 - tone.black);
  };
  const double white = stretched(quantile(samples, kBrightest));
  if (white <= 0) return {};
  tone.exposure = std::clamp(-std::log2(white), 0.0, kExposureRange.max);
  const double middle = stretched(quantile(samples, 0.5)) * std::exp2(tone.exposure);
  if (middle > 0 && middle < kMiddle) {
    tone.gamma = std::min(std::log(middle) / std::log(kMiddle), kGammaRange.max);
  }
  return tone;
}

bool is_dark(const LightField& light_field, ViewIndex view) {
  std::vector<float> samples = shown_samples(light_field, view);
  return !samples.empty() && quantile(samples, 0.5) < kDark;
}

ToneTable::ToneTable(const Tone& tone) {
  const double gain = std::exp2(tone.exposure) / (1 - tone.black);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double sample = static_cast<double>(i) / static_cast<double>(table_.size() - 1);
    const double linear = std::clamp((sample - tone.black) * gain, 0.0, 1.0);
    table_[i] = static_cast<std::uint8_t>(std::lround(255 * std::pow(linear, 1 / tone.gamma)));
  }
}

std::shared_ptr<const ToneTable> table_of(const Tone& tone) {
  return tone.is_plain() ? nullptr : std::make_shared<const ToneTable>(tone);
}

}  // namespace episcope::render
