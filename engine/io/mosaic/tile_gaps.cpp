// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/tile_gaps.h"

#include "engine/io/mosaic/picture_lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

constexpr int kSmallestTile = 32;
constexpr float kOneColour = 0.004F;  ///< A step of 8 bits, of the brightest sample.

struct Run {
  int begin = 0;
  int end = 0;
  [[nodiscard]] int length() const { return end - begin; }
};

/// Where all lines have one and the same brightness.
std::vector<Run> runs_of_one_colour(const Image<float>& lines) {
  const int width = lines.width();
  std::vector<float> least(lines.row(0), lines.row(0) + width);
  std::vector<float> most = least;
  for (int i = 1; i < lines.height(); ++i) {
    for (int x = 0; x < width; ++x) {
      least[static_cast<std::size_t>(x)] =
          std::min(least[static_cast<std::size_t>(x)], lines.at(i, x));
      most[static_cast<std::size_t>(x)] =
          std::max(most[static_cast<std::size_t>(x)], lines.at(i, x));
    }
  }
  const float step = kOneColour * *std::ranges::max_element(most);
  std::vector<Run> runs;
  for (int x = 0; x < width; ++x) {
    const auto at = static_cast<std::size_t>(x);
    if (most[at] - least[at] > step) continue;
    const bool goes_on =
        !runs.empty() && runs.back().end == x && std::abs(most[at] - most[at - 1]) <= step;
    if (!goes_on) runs.push_back({x, x});
    runs.back().end = x + 1;
  }
  return runs;
}

/// Nothing if the runs are not at equal distances.
std::optional<TileGaps> gaps_along(const AnyImage& picture, Axis axis) {
  const Image<float> lines = picture_lines(picture, axis);
  if (lines.empty()) return std::nullopt;
  std::vector<Run> runs = runs_of_one_colour(lines);
  TileGaps found;
  int end = lines.width();
  if (!runs.empty() && runs.back().end == end) {
    end = runs.back().begin;
    runs.pop_back();
  }
  if (!runs.empty() && runs.front().begin == 0) {
    found.first = runs.front().end;
    runs.erase(runs.begin());
  }
  found.count = static_cast<int>(runs.size()) + 1;
  found.length = (runs.empty() ? end : runs.front().begin) - found.first;
  found.gap = runs.empty() ? 0 : runs.front().length();
  if (found.length < kSmallestTile) return std::nullopt;
  int begin = found.first;
  for (const Run& run : runs) {
    if (run.begin - begin != found.length || run.length() != found.gap) return std::nullopt;
    begin = run.end;
  }
  return end - begin == found.length ? std::optional(found) : std::nullopt;
}

bool is_border_of_each(const TileGaps& tiles, int length) {
  const int last = tiles.first + tiles.count * tiles.length + (tiles.count - 1) * tiles.gap;
  return tiles.first + length - last == tiles.gap;
}

}  // namespace

std::string ContactSheet::text() const {
  return fmt::format("gaps of {}×{} px left out", x.gap, y.gap);
}

std::optional<ContactSheet> find_contact_sheet(const AnyImage& picture) {
  const auto x = gaps_along(picture, Axis::X);
  if (!x) return std::nullopt;
  const auto y = gaps_along(picture, Axis::Y);
  if (!y || x->count * y->count == 1) return std::nullopt;
  const auto [height, width] = std::visit(
      [](const auto& image) { return std::pair(image.height(), image.width()); }, picture);
  if (is_border_of_each(*x, width) && is_border_of_each(*y, height)) return std::nullopt;
  return ContactSheet{*x, *y};
}

AnyImage without_gaps(const AnyImage& picture, const ContactSheet& sheet) {
  return std::visit(
      [&]<class T>(const Image<T>& image) -> AnyImage {
        const auto [x, y] = std::pair(sheet.x, sheet.y);
        const int channels = image.channels();
        Image<T> out(y.count * y.length, x.count * x.length, channels);
        for (int row = 0; row < out.height(); ++row) {
          const T* from = image.row(y.first + row / y.length * (y.length + y.gap) + row % y.length);
          for (int u = 0; u < x.count; ++u) {
            std::copy_n(from + (x.first + u * (x.length + x.gap)) * channels, x.length * channels,
                        out.row(row) + u * x.length * channels);
          }
        }
        return out;
      },
      picture);
}

}  // namespace episcope::io
