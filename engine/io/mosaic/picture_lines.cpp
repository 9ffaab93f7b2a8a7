// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/picture_lines.h"

#include <algorithm>

namespace episcope::io {
namespace {

constexpr int kMostLines = 400;

/// Not a multiple of the distance of two lines, or all of them would show the same part of
/// lenslets.
int spread(int line, int lines, int length) {
  return static_cast<int>((line + 0.5) * length / lines);
}

template <class T>
float brightness(const T* pixel, int channels) {
  float sum = 0;
  for (int c = 0; c < channels; ++c) sum += static_cast<float>(pixel[c]);
  return sum / static_cast<float>(channels);
}

}  // namespace

Image<float> picture_lines(const AnyImage& picture, Axis axis) {
  return std::visit(
      [axis](const auto& image) {
        const int across = axis == Axis::X ? image.height() : image.width();
        const int along = axis == Axis::X ? image.width() : image.height();
        Image<float> lines(std::min(across, kMostLines), along);
        // Row by row of the picture in both cases, as it lies in memory.
        for (int i = 0; i < (axis == Axis::X ? lines.height() : along); ++i) {
          const auto* row = image.row(axis == Axis::X ? spread(i, lines.height(), across) : i);
          for (int k = 0; k < (axis == Axis::X ? along : lines.height()); ++k) {
            const int x = axis == Axis::X ? k : spread(k, lines.height(), across);
            const float value = brightness(row + x * image.channels(), image.channels());
            (axis == Axis::X ? lines.at(i, k) : lines.at(k, i)) = value;
          }
        }
        return lines;
      },
      picture);
}

}  // namespace episcope::io
