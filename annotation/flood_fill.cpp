// SPDX-License-Identifier: BSD-3-Clause
#include "annotation/flood_fill.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

namespace episcope {
namespace {

/// Which pixels a fill may pass, 1 or 0; rows are computed when the fill reaches them. Pixels
/// already taken no longer pass.
template <class OpenRow>
class OpenPixels {
 public:
  OpenPixels(int height, int width, const OpenRow& open_row)
      : open_(height, width), is_known_(static_cast<std::size_t>(height)), open_row_(open_row) {}

  std::uint8_t* row(int y) {
    std::uint8_t* row = open_.row(y);
    if (std::exchange(is_known_[static_cast<std::size_t>(y)], std::uint8_t{1}) == 0)
      open_row_(y, row);
    return row;
  }

 private:
  Image<std::uint8_t> open_;
  std::vector<std::uint8_t> is_known_;
  const OpenRow& open_row_;
};

/// The first column from `x` on that is `value`; `end` if there is none.
int first_of(const std::uint8_t* row, std::uint8_t value, int x, int end) {
  const void* found = std::memchr(row + x, value, static_cast<std::size_t>(end - x));
  return found ? static_cast<int>(static_cast<const std::uint8_t*>(found) - row) : end;
}

/// Spans of the connected pixels that are 1 in the rows given by `open_row(y, row)`.
template <class OpenRow>
PixelRegion connected_region(int height, int width, PixelIndex seed, const OpenRow& open_row) {
  PixelRegion region;
  if (seed.y < 0 || seed.y >= height || seed.x < 0 || seed.x >= width) return region;
  OpenPixels<OpenRow> pixels(height, width, open_row);
  std::vector<PixelIndex> starts{seed};
  while (!starts.empty()) {
    const PixelIndex pixel = starts.back();
    starts.pop_back();
    std::uint8_t* row = pixels.row(pixel.y);
    if (row[pixel.x] == 0) continue;
    PixelSpan span{pixel.y, pixel.x, first_of(row, 0, pixel.x, width)};
    while (span.x0 > 0 && row[span.x0 - 1] != 0) --span.x0;
    std::fill(row + span.x0, row + span.x1, std::uint8_t{0});
    region.push_back(span);
    for (const int y : {span.y - 1, span.y + 1}) {
      if (y < 0 || y >= height) continue;
      const std::uint8_t* next = pixels.row(y);
      // The first of each stretch is enough: its span covers the rest.
      for (int x = first_of(next, 1, span.x0, span.x1); x < span.x1;) {
        starts.push_back({y, x});
        x = first_of(next, 0, x, span.x1);
        x = first_of(next, 1, x, span.x1);
      }
    }
  }
  return region;
}

/// Squared norms of the color gradient along a row; one-sided at the border.
class GradientRow {
 public:
  explicit GradientRow(ImageView<const float> picture)
      : picture_(picture), squares_(static_cast<std::size_t>(picture.width) * picture.channels) {}

  /// 1 where the gradient is below the limit.
  void mark_below(float limit, int y, std::uint8_t* row) {
    add_up(y);
    const int channels = picture_.channels;
    const float* square = squares_.data();
    for (int x = 0; x < picture_.width; ++x, square += channels) {
      float sum = 0;
      for (int c = 0; c < channels; ++c) sum += square[c];
      row[x] = sum < limit ? 1 : 0;
    }
  }

 private:
  // By samples, not by pixels: neighbors in memory are computed side by side.
  void add_up(int y) {
    const int channels = picture_.channels;
    const int count = picture_.width * channels;
    const float* row = picture_.row(y);
    const float* up = picture_.row(std::max(y - 1, 0));
    const float* down = picture_.row(std::min(y + 1, picture_.height - 1));
    const int rows = std::min(y + 1, picture_.height - 1) - std::max(y - 1, 0);
    const float along_y = rows > 0 ? 1.0F / static_cast<float>(rows) : 0.0F;
    const auto square = [&](int i, int right, int left, float along_x) {
      const float dx = (row[right] - row[left]) * along_x;
      const float dy = (down[i] - up[i]) * along_y;
      squares_[static_cast<std::size_t>(i)] = dx * dx + dy * dy;
    };
    for (int i = channels; i < count - channels; ++i) square(i, i + channels, i - channels, 0.5F);
    const float one_sided = picture_.width > 1 ? 1.0F : 0.0F;
    const int step = picture_.width > 1 ? channels : 0;
    for (int c = 0; c < channels; ++c) {
      square(c, c + step, c, one_sided);
      const int last = count - channels + c;
      square(last, last, last - step, one_sided);
    }
  }

  ImageView<const float> picture_;
  std::vector<float> squares_;
};

}  // namespace

PixelRegion region_within_edges(ImageView<const float> picture, PixelIndex seed,
                                double max_gradient) {
  if (!(max_gradient >= 0)) {
    throw InvalidInput(
        fmt::format("a fill cannot stop at a gradient of {:f}; choose 0 or more", max_gradient));
  }
  const auto limit = static_cast<float>(max_gradient * max_gradient);
  GradientRow gradient(picture);
  return connected_region(picture.height, picture.width, seed,
                          [&](int y, std::uint8_t* row) { gradient.mark_below(limit, y, row); });
}

PixelRegion region_of_segment(ImageView<const std::int32_t> segmentation, PixelIndex seed) {
  const bool is_inside =
      seed.y >= 0 && seed.y < segmentation.height && seed.x >= 0 && seed.x < segmentation.width;
  if (!is_inside) return {};
  const std::int32_t label = segmentation.at(seed.y, seed.x);
  return connected_region(segmentation.height, segmentation.width, seed,
                          [&](int y, std::uint8_t* row) {
                            const std::int32_t* labels = segmentation.row(y);
                            std::transform(labels, labels + segmentation.width, row,
                                           [label](std::int32_t each) { return each == label; });
                          });
}

}  // namespace episcope
