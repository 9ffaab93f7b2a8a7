// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/sensor.h"

#include "engine/scenes/draw.h"

#include <algorithm>
#include <cmath>

namespace episcope::scenes {

float Exposure::gain(ViewIndex steps) const {
  if (sensor_.gain_spread == 0 || steps == ViewIndex{0, 0}) return 1;
  // Numbers views so that a grid of another size gives the same gain.
  const auto v = static_cast<std::uint64_t>(steps.v + 1024);
  const auto u = static_cast<std::uint64_t>(steps.u + 1024);
  const std::uint64_t bits = mix(mix(format_.seed * kGolden + 2) + (v * 4096 + u) * kGolden);
  const float signed_unit = static_cast<float>(bits >> 40) / 8388608.0F - 1.0F;
  return 1 + sensor_.gain_spread * signed_unit;
}

float Exposure::noise_sigma(int y) const {
  const double share = (y + 0.5) / format_.height;
  const double own = sensor_.noise_top + share * (sensor_.noise_bottom - sensor_.noise_top);
  return static_cast<float>(std::sqrt(own * own + format_.noise_sigma * format_.noise_sigma));
}

void Exposure::write_row(ViewIndex steps, int y, const float* rgb, std::uint64_t counter,
                         std::uint8_t* out) const {
  const int channels = format_.channels;
  const float sigma = noise_sigma(y);
  const float full = 255.0F * (sensor_.exposure * gain(steps));
  const auto middle_x = static_cast<float>((format_.width - 1) / 2.0);
  const float from_middle_y =
      static_cast<float>(y) - static_cast<float>((format_.height - 1) / 2.0);
  const float corner =
      middle_x * middle_x + 0.25F * static_cast<float>((format_.height - 1) * (format_.height - 1));
  for (int x = 0; x < format_.width; ++x, rgb += 3) {
    const float grey = 0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2];  // BT.601
    const float from_middle_x = static_cast<float>(x) - middle_x;
    const float squared = from_middle_x * from_middle_x + from_middle_y * from_middle_y;
    const float light = full * (1 - sensor_.vignetting * (squared / corner));
    for (int c = 0; c < channels; ++c, ++counter) {
      float value = light * (channels == 1 ? grey : rgb[c]);
      if (sigma > 0) value += sigma * sensor_noise(format_.seed, counter);
      *out++ = static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F);
    }
  }
}

float sensor_noise(unsigned seed, std::uint64_t counter) {
  const std::uint64_t stream = mix(seed * kGolden + 1);
  std::uint32_t sum = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    const std::uint64_t bits = mix(stream + (3 * counter + i) * kGolden);
    for (int k = 0; k < 4; ++k) sum += static_cast<std::uint32_t>(bits >> (16 * k) & 0xFFFF);
  }
  // The mean of a 16-bit number is 0x7FFF.8.
  return (static_cast<float>(sum) - 12 * 32767.5F) / 65536.0F;
}

}  // namespace episcope::scenes
