// SPDX-License-Identifier: BSD-3-Clause
#include "engine/solvers/layered_sweep.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/solvers/shared_constants.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace episcope {
namespace {

// More threads than this, or than iterations, are better employed on bands of rows.
constexpr int kMostStaggered = 3;

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

bool is_any_near(const float* cost, const float* least, int count, float behind) {
  int near = 0;
  for (int x = 0; x < count; ++x) near |= cost[x] - least[x] < behind ? 1 : 0;
  return near != 0;
}

LayerList as_list(const std::vector<std::uint16_t>& layers) {
  return {layers.data(), static_cast<int>(layers.size())};
}

}  // namespace

PairLimits::PairLimits(int height, int width, double weight, ImageView<const float> g)
    : pitch_(layer_pitch(width)),
      memory_(static_cast<std::size_t>(height) * kPairKinds * pitch_ + 2 * kLayerRowUnit) {
  for (int y = 0; y < height; ++y) {
    const bool down = y + 1 < height;
    // The share of diagonals missing above the first row and below the last one.
    const float along =
        kPairSide + kPairDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
    for (int x = 0; x < width; ++x) {
      const bool right = x + 1 < width;
      const float aside =
          kPairSide + kPairDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
      const float here = static_cast<float>(weight) * (g.empty() ? 1.0F : g.at(y, x));
      const float diagonal = right && down ? here * kPairDiagonal : 0;
      memory_[begin_of(y, 0) + x] = right ? here * along : 0;
      memory_[begin_of(y, 1) + x] = down ? here * aside : 0;
      memory_[begin_of(y, 2) + x] = diagonal;
      memory_[begin_of(y, 3) + x] = diagonal;
    }
  }
}

void take_cheapest(VolumeView<const float> cost, int y, int* labels, std::vector<float>& least) {
  least.assign(cost.row(y, 0), cost.row(y, 0) + cost.width);
  std::fill_n(labels, cost.width, 0);
  for (int l = 1; l < cost.layers; ++l) {
    const float* const row = cost.row(y, l);
    for (int x = 0; x < cost.width; ++x) {
      labels[x] = row[x] < least[x] ? l : labels[x];
      least[x] = std::min(least[x], row[x]);
    }
  }
}

void check_boundaries(ImageView<const float> g, double smoothness, int height, int width) {
  if (!g.empty() && (g.height != height || g.width != width || g.channels != 1)) {
    throw InvalidInput(fmt::format("a labeling needs edge weights of {} by {} pixels, not {} by {}",
                                   width, height, g.width, g.height));
  }
  if (!(smoothness >= 0)) throw InvalidInput("the smoothness of a labeling must not be negative");
}

double labeling_gap(double energy, double bound) {
  if (energy == bound) return 0;
  return energy == 0 ? 1 : (energy - bound) / std::abs(energy);
}

std::string labeling_gap_text(double gap) {
  return fmt::format("labeling, gap {:.1e}", gap);
}

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

RacingLayers::RacingLayers(int height, int layers, int width)
    : height_(height),
      layers_(layers),
      width_(width),
      across_((width + kLayerColumns - 1) / kLayerColumns),
      down_((height + kTileRows - 1) / kTileRows) {}

void RacingLayers::choose(VolumeView<const float> cost, float behind, ImageView<const int> labels,
                          const Progress& progress) {
  const std::size_t tiles = static_cast<std::size_t>(across_) * down_;
  near_.assign(tiles, {});
  moving_.resize(tiles);
  lists_.resize(tiles);
  blocks_.resize(static_cast<std::size_t>(height_) * across_);
  parallel_for(down_, progress, [&](int row) { find_near(cost, behind, labels, row); });
  for (int row = 0; row < down_; ++row) {
    for (int column = 0; column < across_; ++column) {
      at(moving_, row, column) = in_any(near_, row - 1, column, row + 1, column);
    }
  }
  parallel_for(down_, progress, [&](int row) {
    for (int column = 0; column < across_; ++column) list(row, column);
  });
  takes_all_ = false;
}

void RacingLayers::find_near(VolumeView<const float> cost, float behind,
                             ImageView<const int> labels, int row) {
  std::vector<float> least;
  std::vector<int> cheapest(static_cast<std::size_t>(width_));
  for (int y = row * kTileRows; y < std::min(height_, (row + 1) * kTileRows); ++y) {
    take_cheapest(cost, y, cheapest.data(), least);
    for (int column = 0; column < across_; ++column) {
      Layers& near = at(near_, row, column);
      const int begin = column * kLayerColumns, end = std::min(width_, begin + kLayerColumns);
      for (int l = 0; l < layers_; ++l) {
        if (near[l]) continue;
        near[l] = is_any_near(cost.row(y, l) + begin, least.data() + begin, end - begin, behind);
      }
      for (int x = begin; x < end; ++x) near.set(labels.at(y, x));
    }
  }
}

RacingLayers::Layers RacingLayers::in_any(const std::vector<Layers>& tiles, int first_row,
                                          int first_column, int last_row, int last_column) const {
  Layers all;
  for (int row = std::max(first_row, 0); row <= std::min(last_row, down_ - 1); ++row) {
    for (int u = std::max(first_column, 0); u <= std::min(last_column, across_ - 1); ++u) {
      all |= tiles[static_cast<std::size_t>(row) * across_ + u];
    }
  }
  return all;
}

void RacingLayers::list(int row, int column) {
  Lists& lists = lists_[static_cast<std::size_t>(row) * across_ + column];
  const auto fill = [&](const Layers& from, std::vector<std::uint16_t>& to) {
    to.clear();
    for (int l = 0; l < layers_; ++l) {
      if (from[l]) to.push_back(static_cast<std::uint16_t>(l));
    }
  };
  const Layers& moving = at(moving_, row, column);
  fill(moving, lists.moving);
  fill(in_any(moving_, row, column, row + 1, column + 1), lists.paired);
  fill(in_any(moving_, row - 1, column - 1, row + 1, column + 1) & ~moving, lists.still);
  for (int y = row * kTileRows; y < std::min(height_, (row + 1) * kTileRows); ++y) {
    blocks_[static_cast<std::size_t>(y) * across_ + column] = {
        as_list(lists.moving), as_list(lists.paired), as_list(lists.still)};
  }
}

}  // namespace episcope
