// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/disparity_field.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"

#include <functional>
#include <string>

namespace episcope::test {

/// A built-in scene of small size, on all threads.
[[nodiscard]] Scene render(const std::string& id, int height, int width, GridShape grid = {9, 9},
                           double disparity_scale = 1, double noise_sigma = 0);

/// A light field of float samples in [0, 1] from `sample(view, y, x, c)`.
using SampleFunction = std::function<float(ViewIndex, int y, int x, int c)>;
[[nodiscard]] LightField make_light_field(GridShape grid, int height, int width, int channels,
                                          const SampleFunction& sample);
[[nodiscard]] LightField like(const LightField& shape, const SampleFunction& sample);

/// All views as float samples, for functions that look samples up.
[[nodiscard]] ViewStack<float> float_samples(const LightField& light_field);

/// Rows and columns of pixels and of cameras exchanged.
[[nodiscard]] LightField transposed(const LightField& light_field);
/// Every disparity larger by `k`; what leaves the image repeats its border.
[[nodiscard]] LightField sheared(const LightField& light_field, int k);
/// The same samples stored as uint16.
[[nodiscard]] LightField as_uint16(const LightField& light_field);
/// The mean of the channels.
[[nodiscard]] LightField grey(const LightField& light_field);

struct Errors {
  double bias = 0;     ///< Mean of estimate − truth, px.
  double mse_100 = 0;  ///< Mean square × 100.
  double worst = 0;    ///< Largest absolute.
};
/// Over all valid pixels `inset` or more px from the border.
[[nodiscard]] Errors errors(const ImageView<const float>& estimate, const DisparityView& truth,
                            int inset);

/// Largest |a − b| of two images of equal size, `inset` or more px from the border.
[[nodiscard]] double largest_difference(const ImageView<const float>& a,
                                        const ImageView<const float>& b, int inset = 0);
[[nodiscard]] double mean(const ImageView<const float>& image, int inset = 0);
/// Whether every element of the stack is finite.
[[nodiscard]] bool all_finite(const ViewStack<float>& stack);
[[nodiscard]] bool same_bytes(const ViewStack<float>& a, const ViewStack<float>& b);

}  // namespace episcope::test
