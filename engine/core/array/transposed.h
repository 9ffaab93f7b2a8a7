// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

#include <algorithm>

namespace episcope {

/// Rows and columns exchanged, channels as they are.
template <class T>
[[nodiscard]] Image<T> transposed(const Image<T>& image) {
  Image<T> turned(image.width(), image.height(), image.channels());
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      std::copy_n(&image.at(y, x), image.channels(), &turned.at(x, y));
    }
  }
  return turned;
}

}  // namespace episcope
