// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/error_maps.h"

#include <algorithm>
#include <cmath>

namespace episcope {

Image<std::uint8_t> present_mask(const Evaluation& evaluation) {
  const Image<float>& error = evaluation.signed_error;
  Image<std::uint8_t> mask(error.height(), error.width(), 1, 1);
  if (evaluation.missing.empty()) return mask;
  std::transform(evaluation.missing.begin(), evaluation.missing.end(), mask.begin(),
                 [](std::uint8_t missing) { return static_cast<std::uint8_t>(missing == 0); });
  return mask;
}

Image<float> absolute_error_map(const Evaluation& evaluation) {
  Image<float> map = evaluation.signed_error;
  for (float& error : map) error = std::abs(error);
  return map;
}

Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px) {
  const auto threshold = static_cast<float>(threshold_px);
  Image<float> map = evaluation.signed_error;
  auto missing = evaluation.missing.begin();
  for (float& error : map) {
    const bool is_missing = *missing++ != 0;
    error = is_missing || std::abs(error) > threshold ? kBadPixel : kGoodPixel;
  }
  return map;
}

}  // namespace episcope
