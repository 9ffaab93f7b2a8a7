// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/islands.h"

#include "engine/core/image.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace episcope {
namespace {

constexpr const char* kIslandsKey = "islands";
constexpr float kAgreement_px = 0.5F;
constexpr std::size_t kLeastAround = 3;  // Pixels that a median is taken of.

struct Offset {
  int y = 0, x = 0;
};

bool agree(float a, float b) {
  return std::abs(a - b) <= kAgreement_px;
}

// A map with a margin that agrees with nothing, so that every pixel has all its neighbors.
class Surroundings {
 public:
  static constexpr int kMargin = 2;

  Surroundings(ImageView<const float> map, const Progress& progress)
      : padded_(map.height + 2 * kMargin, 1, map.width + 2 * kMargin) {
    parallel_for(padded_.height(), progress, [&](int i) { fill(map, i - kMargin); });
  }
  // Readable for the margin on either side, and above and below.
  [[nodiscard]] float* row(int y) { return padded_.view().row(y + kMargin, 0) + kMargin; }
  [[nodiscard]] const float* row(int y) const {
    return padded_.view().row(y + kMargin, 0) + kMargin;
  }
  void forget(Offset at) { row(at.y)[at.x] = kNothing; }

  // Calls `visit(y, x, value)` for the pixels within `radius` of a pixel, itself left out.
  template <class Visit>
  void for_around(Offset at, int radius, Visit&& visit) const {
    for (int y = at.y - radius; y <= at.y + radius; ++y) {
      for (int x = at.x - radius; x <= at.x + radius; ++x) {
        if (y != at.y || x != at.x) visit(y, x, row(y)[x]);
      }
    }
  }

 private:
  static constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

  void fill(ImageView<const float> map, int y) {
    float* const first = row(y) - kMargin;
    if (y < 0 || y >= map.height) {
      std::fill_n(first, padded_.width(), kNothing);
      return;
    }
    std::fill_n(first, kMargin, kNothing);
    std::copy_n(map.row(y), map.width, row(y));
    std::fill_n(row(y) + map.width, kMargin, kNothing);
  }

  Volume<float> padded_;
};

// How many of its neighbors agree with a pixel.
int agreeing(const Surroundings& map, int y, int x) {
  const float* const above = map.row(y - 1) + x;
  const float* const here = map.row(y) + x;
  const float* const below = map.row(y + 1) + x;
  const float own = *here;
  return int{agree(above[-1], own)} + int{agree(above[0], own)} + int{agree(above[1], own)} +
         int{agree(here[-1], own)} + int{agree(here[1], own)} + int{agree(below[-1], own)} +
         int{agree(below[0], own)} + int{agree(below[1], own)};
}

// Of a pixel with which one neighbor agrees, or none.
bool is_island(const Surroundings& map, Offset at) {
  const float own = map.row(at.y)[at.x];
  if (!std::isfinite(own)) return false;
  bool is_alone = true;
  int nearer = 0, farther = 0;
  map.for_around(at, 1, [&](int y, int x, float other) {
    if (agree(other, own)) {
      is_alone = is_alone && agreeing(map, y, x) == 1;
    } else {
      nearer += other > own ? 1 : 0;
      farther += other < own ? 1 : 0;
    }
  });
  return is_alone && (nearer == 0 || farther == 0);
}

// Of each row.
std::vector<std::vector<Offset>> find_islands(const Surroundings& map, int height, int width,
                                              const Progress& progress) {
  std::vector<std::vector<Offset>> islands(static_cast<std::size_t>(height));
  parallel_for_workers(height, progress, [&] {
    return [&, counts = std::vector<int>(static_cast<std::size_t>(width))](int y) mutable {
      for (int x = 0; x < width; ++x) counts[x] = agreeing(map, y, x);
      for (int x = 0; x < width; ++x) {
        if (counts[x] <= 1 && is_island(map, {y, x})) islands[y].push_back({y, x});
      }
    };
  });
  return islands;
}

// The median of what is known around a pixel; `own` where that is too little.
float median_around(const Surroundings& known, Offset at, float own) {
  std::vector<float> values;
  for (int radius = 1; radius <= Surroundings::kMargin && values.size() < kLeastAround; ++radius) {
    values.clear();
    known.for_around(at, radius, [&](int, int, float value) {
      if (std::isfinite(value)) values.push_back(value);
    });
  }
  if (values.size() < kLeastAround) return own;
  return quantile(values, 0.5);
}

}  // namespace

Schema<IslandParameters> island_schema() {
  return Schema<IslandParameters>().flag(
      kIslandsKey, &IslandParameters::islands,
      {"Fill islands",
       "One or two pixels nearer than all their neighbors, or farther, take the median of these; "
       "off, as in the paper"});
}

ParameterSet plain_islands() {
  return {{kIslandsKey, false}};
}

void fill_islands(const Progress& progress, ImageView<float> disparity) {
  Surroundings map(disparity, progress);
  const auto islands = find_islands(map, disparity.height, disparity.width, progress);
  for (const std::vector<Offset>& row : islands) {
    for (const Offset& island : row) map.forget(island);
  }
  for (const std::vector<Offset>& row : islands) {
    for (const Offset& island : row) {
      float& value = disparity.at(island.y, island.x);
      value = median_around(map, island, value);
    }
  }
}

void fill_islands(const IslandParameters& parameters, const Progress& progress,
                  ImageView<float> disparity) {
  if (parameters.islands) fill_islands(progress, disparity);
}

}  // namespace episcope
