// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"

#include <cstdint>

namespace episcope::scenes {

/// How the cameras turn light into samples; by default exactly.
struct Sensor {
  float exposure = 1;     ///< Factor of all samples; small = a dark scene.
  float vignetting = 0;   ///< Share of the light that is lost in the corners of a view.
  float gain_spread = 0;  ///< Gains of the views lie within 1 ± this; the center view has 1.
  /// Standard deviation of the noise in units of 1/255, at the top of a view and at its bottom.
  float noise_top = 0;
  float noise_bottom = 0;
  /// Side of the part of a pixel that light falls on, px; below 1, detail finer than a pixel is
  /// aliased: it changes from view to view. 0 = a single ray.
  float fill = 1;
};

/// Exposes the rows of all views of one scene.
class Exposure {
 public:
  struct Format {
    int height = 0;
    int width = 0;
    int channels = 3;
    double noise_sigma = 0;  ///< Of further noise, in units of 1/255.
    unsigned seed = 1;       ///< Of noise and gains.
  };
  Exposure(const Sensor& sensor, const Format& format) : sensor_(sensor), format_(format) {}

  /// Row `y` of the view `steps` away from the center view. `rgb`: light, [x][3]; `out`: samples,
  /// [x][channels], of which the first is number `counter` of the light field.
  void write_row(ViewIndex steps, int y, const float* rgb, std::uint64_t counter,
                 std::uint8_t* out) const;

  /// The gain of a view.
  [[nodiscard]] float gain(ViewIndex steps) const;

 private:
  [[nodiscard]] float noise_sigma(int y) const;

  Sensor sensor_;
  Format format_;
};

/// A normally distributed number of variance 1 that depends on `seed` and `counter` alone: the sum
/// of twelve uniform numbers minus six, so that no function of the maths library is involved.
[[nodiscard]] float sensor_noise(unsigned seed, std::uint64_t counter);

}  // namespace episcope::scenes
