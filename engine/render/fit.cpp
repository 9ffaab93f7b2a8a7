// SPDX-License-Identifier: BSD-3-Clause
#include "engine/render/fit.h"

#include <algorithm>

namespace episcope::render {
namespace {

using Picture = Image<std::uint8_t>;

/// Mean of the samples of `source` in rows [y0, y1) and columns [x0, x1).
std::uint8_t mean(const Picture& source, int y0, int y1, int x0, int x1, int c) {
  long sum = 0;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) sum += source.at(y, x, c);
  }
  const long count = static_cast<long>(y1 - y0) * (x1 - x0);
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

/// Where the i-th of `to` equal parts of `from` begins.
int begin_of(int i, int from, int to) {
  return static_cast<int>(static_cast<long>(i) * from / to);
}

}  // namespace

Picture fitted(const Picture& picture, int longest_px) {
  const int longer = std::max(picture.height(), picture.width());
  if (longer <= longest_px) return picture;
  const auto scaled = [&](int length) {
    return std::max(1, static_cast<int>(static_cast<long>(length) * longest_px / longer));
  };
  Picture small(scaled(picture.height()), scaled(picture.width()), picture.channels());
  for (int y = 0; y < small.height(); ++y) {
    const int y0 = begin_of(y, picture.height(), small.height());
    const int y1 = std::max(y0 + 1, begin_of(y + 1, picture.height(), small.height()));
    for (int x = 0; x < small.width(); ++x) {
      const int x0 = begin_of(x, picture.width(), small.width());
      const int x1 = std::max(x0 + 1, begin_of(x + 1, picture.width(), small.width()));
      for (int c = 0; c < small.channels(); ++c) {
        small.at(y, x, c) = mean(picture, y0, y1, x0, x1, c);
      }
    }
  }
  return small;
}

}  // namespace episcope::render
