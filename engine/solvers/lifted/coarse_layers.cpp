// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted/coarse_layers.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace episcope {
namespace {

void halve_rows(const float* upper, const float* lower, int width, float* out) {
  for (int x = 0; x + 1 < width; x += 2) {
    out[x / 2] = 0.25F * (upper[x] + upper[x + 1] + lower[x] + lower[x + 1]);
  }
  if (width % 2 == 1) out[width / 2] = 0.5F * (upper[width - 1] + lower[width - 1]);
}

// Twice the mean of `near` and `other`, rows of the coarse duals of one layer, at every fine pixel.
// Pairs that lead to the right end within a coarse pixel at even x: there the flow is between that
// which enters it and that which leaves.
void spread_row(const float* near, const float* other, int width, bool rightwards, float* out) {
  for (int x = 0; x < width; ++x) {
    const int at = x / 2;
    const bool inside = rightwards && x % 2 == 0;
    const float left = !inside ? near[at] + other[at] : at > 0 ? near[at - 1] + other[at - 1] : 0;
    out[x] = 0.5F * (near[at] + other[at] + left);
  }
}

void begin_row(LayeredSweep& coarse, const PairDuals& near, const PairDuals& above, int y,
               const PairDuals& duals, LayeredSweep& fine) {
  const LayeredShape& shape = fine.shape();
  const long pitch = coarse.shape().pitch;
  const float* const from = coarse.phi(y / 2);
  for (int layer = 0; layer < shape.steps; ++layer) {
    float* const to = fine.phi(y) + layer * shape.pitch;
    for (int x = 0; x < shape.width; ++x) to[x] = from[layer * pitch + x / 2];
    for (int k = 0; k < kPairKinds; ++k) {
      // Likewise for pairs that lead down, at even y.
      const bool inside = k == 1 && y % 2 == 0;
      spread_row(near.pair[k] + layer * pitch, (inside ? above : near).pair[k] + layer * pitch,
                 shape.width, k == 0, duals.pair[k] + layer * shape.pitch);
    }
  }
}

// Where in phi() of row 0 each pixel of a row begins, and in its duals, layer 0 of pair 0.
struct Places {
  explicit Places(int width) : phi(width), duals(width) {}
  std::vector<long> phi, duals;
};

void find_places(const LayeredSweep& from, ImageView<const std::int32_t> places, int y,
                 Places& found) {
  const int width = places.width;
  for (int x = 0; x < width; ++x) {
    const std::int32_t named = places.at(y, x);
    const std::int32_t at = named < 0 ? y * width + x : named;
    found.phi[x] = at / width * from.row_size() + at % width;
    found.duals[x] = long{at / width} * kPairKinds * from.row_size() + at % width;
  }
}

// The layers that are listed, in columns from `begin` on, of the layers of a row.
void gather(const float* from, const std::vector<long>& places, const LayerList& listed, int begin,
            long pitch, float* to) {
  const int end = std::min(begin + kLayerColumns, static_cast<int>(places.size()));
  for (int k = 0; k < listed.count; ++k) {
    const long layer = listed.layers[k] * pitch;
    for (int x = begin; x < end; ++x) to[layer + x] = from[layer + places[x]];
  }
}

}  // namespace

void halve(VolumeView<const float> from, const Progress& progress, VolumeView<float> to) {
  parallel_for(to.height, progress, [&](int y) {
    for (int layer = 0; layer < to.layers; ++layer) {
      halve_rows(from.row(2 * y, layer), from.row(std::min(2 * y + 1, from.height - 1), layer),
                 from.width, to.row(y, layer));
    }
  });
}

Image<float> halved(ImageView<const float> from) {
  Image<float> to((from.height + 1) / 2, (from.width + 1) / 2);
  for (int y = 0; y < to.height(); ++y) {
    halve_rows(from.row(2 * y), from.row(std::min(2 * y + 1, from.height - 1)), from.width,
               to.row(y));
  }
  return to;
}

void begin_from(LayeredSweep& coarse, const Progress& progress, LayeredSweep& fine) {
  parallel_for(fine.bands(), progress, [&](int i) {
    const auto band = fine.band(i);
    fine.clear(band);
    for (int y = band.begin; y < band.end; ++y) {
      begin_row(coarse, coarse.duals(y / 2), coarse.duals_above(y / 2), y, fine.duals(y), fine);
    }
  });
}

void begin_from_moved(LayeredSweep& from, ImageView<const std::int32_t> places,
                      const RacingLayers& racing, const Progress& progress, LayeredSweep& to) {
  const LayeredShape& shape = to.shape();
  std::vector<std::uint16_t> all(static_cast<std::size_t>(shape.steps));
  std::iota(all.begin(), all.end(), std::uint16_t{0});
  const LayerList everything{all.data(), shape.steps};
  parallel_for(to.bands(), progress, [&](int i) {
    const auto band = to.band(i);
    to.clear(band);
    Places found(shape.width);
    const PairDuals first = from.duals(0);
    for (int y = band.begin; y < band.end; ++y) {
      find_places(from, places, y, found);
      const PairDuals duals = to.duals(y);
      const LayerBlock* const blocks = racing.row(y);
      for (int begin = 0; begin < shape.width; begin += kLayerColumns) {
        const LayerBlock block = blocks != nullptr ? blocks[begin / kLayerColumns]
                                                   : LayerBlock{everything, everything, {}};
        gather(from.phi(0), found.phi, block.moving, begin, shape.pitch, to.phi(y));
        for (int k = 0; k < kPairKinds; ++k) {
          gather(first.pair[k], found.duals, block.paired, begin, shape.pitch, duals.pair[k]);
        }
      }
    }
  });
}

}  // namespace episcope
