// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/common/islands.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace episcope {
namespace {

constexpr const char* kIslandsKey = "islands";
constexpr float kAgreement_px = 0.5F;
constexpr int kLeastAround = 3;  ///< Pixels that a median is taken of.

struct Offset {
  int y = 0, x = 0;
};
/// Each pair of neighbours once.
constexpr Offset kPairs[] = {{0, 1}, {1, -1}, {1, 0}, {1, 1}};

bool agree(float a, float b) {
  return std::abs(a - b) <= kAgreement_px;
}

/// How many of its neighbours agree with each pixel.
Image<std::uint8_t> count_agreeing(ImageView<const float> map) {
  Image<std::uint8_t> counts(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    for (const Offset& pair : kPairs) {
      if (y + pair.y >= map.height) continue;
      const float* const here = map.row(y);
      const float* const there = map.row(y + pair.y) + pair.x;
      std::uint8_t* const of_here = counts.row(y);
      std::uint8_t* const of_there = counts.row(y + pair.y) + pair.x;
      const int begin = std::max(0, -pair.x), end = map.width - std::max(0, pair.x);
      for (int x = begin; x < end; ++x) {
        const auto one = static_cast<std::uint8_t>(agree(here[x], there[x]) ? 1 : 0);
        of_here[x] = static_cast<std::uint8_t>(of_here[x] + one);
        of_there[x] = static_cast<std::uint8_t>(of_there[x] + one);
      }
    }
  }
  return counts;
}

/// Calls `visit(y, x)` for the pixels within `radius` of a pixel, itself left out.
template <class Visit>
void for_around(ImageView<const float> map, Offset at, int radius, Visit&& visit) {
  const int bottom = std::min(at.y + radius, map.height - 1);
  const int right = std::min(at.x + radius, map.width - 1);
  for (int y = std::max(at.y - radius, 0); y <= bottom; ++y) {
    for (int x = std::max(at.x - radius, 0); x <= right; ++x) {
      if (y != at.y || x != at.x) visit(y, x);
    }
  }
}

bool is_island(ImageView<const float> map, const Image<std::uint8_t>& counts, Offset at) {
  const int count = counts.at(at.y, at.x);
  if (count > 1 || !std::isfinite(map.at(at.y, at.x))) return false;
  const float own = map.at(at.y, at.x);
  bool is_alone = true;
  int nearer = 0, farther = 0;
  for_around(map, at, 1, [&](int y, int x) {
    const float other = map.at(y, x);
    if (agree(other, own)) {
      is_alone = is_alone && counts.at(y, x) == 1;
    } else {
      nearer += other > own ? 1 : 0;
      farther += other < own ? 1 : 0;
    }
  });
  return is_alone && (nearer == 0 || farther == 0);
}

std::vector<Offset> find_islands(ImageView<const float> map) {
  const Image<std::uint8_t> counts = count_agreeing(map);
  std::vector<Offset> islands;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (is_island(map, counts, {y, x})) islands.push_back({y, x});
    }
  }
  return islands;
}

/// The median of what is known around a pixel; its own value where that is too little.
float median_around(const Image<float>& known, ImageView<const float> map, Offset at) {
  std::vector<float> values;
  for (int radius = 1; radius <= 2 && values.size() < kLeastAround; ++radius) {
    values.clear();
    for_around(map, at, radius, [&](int y, int x) {
      if (std::isfinite(known.at(y, x))) values.push_back(known.at(y, x));
    });
  }
  if (values.size() < kLeastAround) return map.at(at.y, at.x);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

Schema<IslandParameters> island_schema() {
  return Schema<IslandParameters>().flag(
      kIslandsKey, &IslandParameters::islands,
      {"Fill islands",
       "One or two pixels nearer than all their neighbours, or farther, take the median of these; "
       "off, as in the paper"});
}

ParameterSet plain_islands() {
  return {{kIslandsKey, false}};
}

void fill_islands(ImageView<float> disparity) {
  const std::vector<Offset> islands = find_islands(disparity);
  if (islands.empty()) return;
  Image<float> known(disparity.height, disparity.width);
  for (int y = 0; y < disparity.height; ++y) {
    std::copy_n(disparity.row(y), disparity.width, known.row(y));
  }
  for (const Offset& island : islands) {
    known.at(island.y, island.x) = std::numeric_limits<float>::quiet_NaN();
  }
  for (const Offset& island : islands) {
    disparity.at(island.y, island.x) = median_around(known, disparity, island);
  }
}

}  // namespace episcope
