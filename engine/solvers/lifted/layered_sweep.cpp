// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted/layered_sweep.h"

#include "engine/core/parallel/flush_denormals.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>

namespace episcope {

LayeredSweep::LayeredSweep(int height, int layers, int width) : height_(height) {
  shape_.steps = layers;
  shape_.width = width;
  shape_.pitch = layer_pitch(width);
  const std::size_t size = static_cast<std::size_t>(height) * row_size();
  phi_ = make_large<float>(size + 2 * kLayerRowUnit);
  duals_ = make_large<float>(kPairKinds * size + 2 * kLayerRowUnit);
  edges_.resize(static_cast<std::size_t>(bands()) * edges_size() + kLayerRowUnit);
  nothing_.resize(static_cast<std::size_t>(row_size()) + 2 * kLayerRowUnit);
  std::fill_n(phi_.get(), kLayerRowUnit, 0.0F);
  std::fill_n(duals_.get(), kLayerRowUnit, 0.0F);
}

LayeredSweep::Band LayeredSweep::band(int i) const {
  return {i * kBandRows, std::min(height_, (i + 1) * kBandRows)};
}

void LayeredSweep::clear(const Band& band) {
  const long margin = band.end == height_ ? kLayerRowUnit : 0;
  const long size = long{band.end - band.begin} * row_size();
  std::fill_n(phi(band.begin), size + margin, 0.0F);
  std::fill_n(duals_.get() + kLayerRowUnit + long{band.begin} * kPairKinds * row_size(),
              kPairKinds * size + margin, 0.0F);
}

PairDuals LayeredSweep::duals(int y) {
  PairDuals row;
  for (int k = 0; k < kPairKinds; ++k) {
    row.pair[k] =
        duals_.get() + kLayerRowUnit + (static_cast<long>(y) * kPairKinds + k) * row_size();
  }
  return row;
}

PairDuals LayeredSweep::duals_above(int y) {
  if (y > 0) return duals(y - 1);
  PairDuals row;
  for (float*& pair : row.pair) pair = nothing_.data() + kLayerRowUnit;
  return row;
}

PairDuals LayeredSweep::duals(int y, const PairLimits& limits) {
  PairDuals row = duals(y);
  for (int k = 0; k < kPairKinds; ++k) row.limit[k] = limits.row(y, k);
  return row;
}

PairDuals LayeredSweep::duals_above(int y, const PairLimits& limits) {
  if (y > 0) return duals(y - 1, limits);
  PairDuals row = duals_above(y);
  for (const float*& limit : row.limit) limit = nothing_.data() + kLayerRowUnit;
  return row;
}

float* LayeredSweep::ahead(int y, float* scratch) {
  const Band all = band(y / kBandRows);
  float* const edges = edges_.data() + kLayerRowUnit + (y / kBandRows) * edges_size();
  if (y == all.begin) return edges;
  if (y == all.end - 1) return edges + row_size();
  return scratch + kLayerRowUnit + (y & 1) * row_size();
}

// A row of φ needs the old duals of its own and of the row above, a row of duals the new φ of its
// own and of the row below: in this order everything is updated in place, and memory is traversed
// once.
void LayeredSweep::iterate(VolumeView<const float> cost, const PairLimits& limits,
                           const LayeredMoves& moves, const Progress& progress) {
  parallel_for_workers(bands(), progress, [&] {
    const std::size_t size = 2 * row_size() + 2 * kLayerRowUnit;
    return [&, scratch = std::vector<float>(size)](int i) mutable {
      const FlushDenormals flush;
      for (int y = band(i).begin; y < band(i).end; ++y) {
        moves.primal(shape_, cost.row(y, 0), duals(y, limits), duals_above(y, limits), phi(y),
                     ahead(y, scratch.data()));
        if (y == band(i).begin) continue;
        moves.dual(shape_, ahead(y - 1, scratch.data()), ahead(y, scratch.data()),
                   duals(y - 1, limits));
      }
    };
  });
  // The last duals of a band wait for the first φ of the next one, and the other way round.
  parallel_for(bands(), progress, [&](int i) {
    const FlushDenormals flush;
    const int y = band(i).end - 1;
    moves.dual(shape_, ahead(y, nullptr), ahead(std::min(y + 1, height_ - 1), nullptr),
               duals(y, limits));
  });
}

}  // namespace episcope
