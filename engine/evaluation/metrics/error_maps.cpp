// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/error_maps.h"

#include <cmath>

namespace episcope {

Image<std::uint8_t> shown_mask(const Evaluation& evaluation) {
  Image<std::uint8_t> mask = evaluation.judged;
  auto missing = evaluation.missing.begin();
  for (std::uint8_t& shown : mask) {
    if (*missing++ != 0) shown = 0;
  }
  return mask;
}

Image<float> absolute_error_map(const Evaluation& evaluation) {
  Image<float> map = evaluation.signed_error;
  for (float& error : map) error = std::abs(error);
  return map;
}

Image<float> bad_pixel_map(const Evaluation& evaluation, double threshold_px) {
  constexpr float good = 0.2F;
  constexpr float bad = 1.0F;
  const auto threshold = static_cast<float>(threshold_px);
  Image<float> map = evaluation.signed_error;
  auto missing = evaluation.missing.begin();
  for (float& error : map) {
    const bool is_missing = *missing++ != 0;
    error = is_missing || std::abs(error) > threshold ? bad : good;
  }
  return map;
}

}  // namespace episcope
