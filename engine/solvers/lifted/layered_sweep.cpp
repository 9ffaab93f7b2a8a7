// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/lifted/layered_sweep.h"

#include "engine/core/parallel/flush_denormals.h"
#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace episcope {
namespace {

// More threads than this, or than iterations, are better employed on bands of rows.
constexpr int kMostStaggered = 3;

}  // namespace

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

void LayeredSweep::clear_all_but(const RacingLayers& racing, const Band& band) {
  const auto clear = [this](const LayerList& kept, int begin, float* row) {
    const int count = std::min(kLayerColumns, shape_.width - begin);
    int next = 0;
    for (int l = 0; l < shape_.steps; ++l) {
      const bool is_kept = next < kept.count && kept.layers[next] == l;
      next += is_kept ? 1 : 0;
      if (!is_kept) std::fill_n(row + l * shape_.pitch + begin, count, 0.0F);
    }
  };
  for (int y = band.begin; y < band.end; ++y) {
    const LayerBlock* block = racing.row(y);
    if (block == nullptr) return;
    const PairDuals pairs = duals(y);
    for (int begin = 0; begin < shape_.width; begin += kLayerColumns, ++block) {
      clear(block->moving, begin, phi(y));
      for (float* const pair : pairs.pair) clear(block->paired, begin, pair);
    }
  }
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

// Iterations that one thread takes through the image, two rows behind those of the part before.
struct LayeredSweep::Part {
  int iterations = 0;
  float* rows = nullptr;                     // Room for two rows of each iteration.
  const std::atomic<int>* before = nullptr;  // Rows that the part before has left behind.
  std::atomic<int>& done;

  // Nobody waits for a part that has ended, however it did.
  ~Part() { leave(std::numeric_limits<int>::max()); }
  void leave(int count) const {
    done.store(count, std::memory_order_release);
    done.notify_one();
  }
  void wait_for(int wanted) const {
    if (before == nullptr) return;
    for (int left = before->load(std::memory_order_acquire); left < wanted;
         left = before->load(std::memory_order_acquire)) {
      before->wait(left, std::memory_order_acquire);
    }
  }
};

void LayeredSweep::iterate(const Terms& terms, int count, const Progress& progress) {
  if (progress.threads() > std::min(kMostStaggered, count)) {
    for (int i = 0; i < count; ++i) iterate_bands(terms, progress);
    return;
  }
  const int parts = progress.threads();
  std::vector<std::atomic<int>> rows_left_behind(static_cast<std::size_t>(parts));
  std::vector<float> rows(2 * count * row_size() + parts * 2 * kLayerRowUnit);
  // A part waits for the one before only, which has been taken by a thread when its turn comes.
  parallel_for(parts, progress, [&](int i) {
    const int first = count * i / parts, end = count * (i + 1) / parts;
    float* const room = rows.data() + 2 * first * row_size() + i * 2 * kLayerRowUnit;
    iterate_part(
        terms,
        {end - first, room, i > 0 ? &rows_left_behind[static_cast<std::size_t>(i - 1)] : nullptr,
         rows_left_behind[static_cast<std::size_t>(i)]},
        progress);
  });
}

void LayeredSweep::move_primal(const Terms& terms, int y, float* ahead) {
  PairDuals here = duals(y, terms.limits);
  if (terms.racing != nullptr) here.blocks = terms.racing->row(y);
  terms.moves.primal(shape_, terms.cost.row(y, 0), here, duals_above(y, terms.limits), phi(y),
                     ahead);
}

void LayeredSweep::move_dual(const Terms& terms, int y, const float* ahead,
                             const float* ahead_below) {
  PairDuals here = duals(y, terms.limits);
  if (terms.racing != nullptr) here.blocks = terms.racing->row(y);
  terms.moves.dual(shape_, ahead, ahead_below, here);
}

// A row of φ needs the old duals of its own and of the row above, a row of duals the new φ of its
// own and of the row below: in this order everything is updated in place, and memory is traversed
// once.
void LayeredSweep::iterate_bands(const Terms& terms, const Progress& progress) {
  parallel_for_workers(bands(), progress, [&] {
    const std::size_t size = 2 * row_size() + 2 * kLayerRowUnit;
    return [&, scratch = std::vector<float>(size)](int i) mutable {
      const FlushDenormals flush;
      for (int y = band(i).begin; y < band(i).end; ++y) {
        move_primal(terms, y, ahead(y, scratch.data()));
        if (y == band(i).begin) continue;
        move_dual(terms, y - 1, ahead(y - 1, scratch.data()), ahead(y, scratch.data()));
      }
    };
  });
  // The last duals of a band wait for the first φ of the next one, and the other way round.
  parallel_for(bands(), progress, [&](int i) {
    const FlushDenormals flush;
    const int y = band(i).end - 1;
    move_dual(terms, y, ahead(y, nullptr), ahead(std::min(y + 1, height_ - 1), nullptr));
  });
}

// When an iteration comes to a row, the one before has left it and its duals, and those above.
void LayeredSweep::iterate_part(const Terms& terms, const Part& part, const Progress& progress) {
  const FlushDenormals flush;
  for (int step = 0; step < height_ + 2 * (part.iterations - 1); ++step) {
    progress.check();
    part.wait_for(std::min(step + 2, height_));
    for (int i = 0; i < part.iterations; ++i) {
      const int y = step - 2 * i;
      if (y < 0 || y >= height_) continue;
      const auto row = [&](int at) {
        return part.rows + kLayerRowUnit + (2 * i + (at & 1)) * row_size();
      };
      move_primal(terms, y, row(y));
      if (y > 0) move_dual(terms, y - 1, row(y - 1), row(y));
      if (y == height_ - 1) move_dual(terms, y, row(y), row(y));
    }
    part.leave(step - 2 * (part.iterations - 1) + 1);
  }
}

}  // namespace episcope
