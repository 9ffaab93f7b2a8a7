// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace episcope::test {

/// Labels from rows of digits; other characters are 0.
inline Image<std::int32_t> labels_from(const std::vector<std::string>& rows) {
  Image<std::int32_t> labels(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int y = 0; y < labels.height(); ++y) {
    for (int x = 0; x < labels.width(); ++x) {
      const char digit = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
      labels.at(y, x) = digit >= '0' && digit <= '9' ? digit - '0' : 0;
    }
  }
  return labels;
}

}  // namespace episcope::test
