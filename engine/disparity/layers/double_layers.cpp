// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/double_layers.h"

#include "engine/core/error.h"
#include "engine/core/parallel/parallel.h"
#include "engine/cuda/layers/double_layers.h"
#include "engine/disparity/layers/double_passes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <vector>

namespace episcope {
namespace {

using Direction = DoubleOrientation::Direction;

// Directions that agree within this many px are averaged.
constexpr float kAgreement = 0.3F;

struct Run {
  int count;
  const float* near;
  const float* far;
  const float* confidence;
};

float eighth_power(float value) {
  const float square = value * value;
  const float fourth = square * square;
  return fourth * fourth;
}

// Into what the other direction left there: confidence 0 if nothing.
void merge(const Run& run, float* near, float* far, std::uint8_t* confidence) {
  for (int i = 0; i < run.count; ++i) {
    const float here = run.confidence[i];
    const float there = static_cast<float>(confidence[i]) / 255;
    const bool agree = here > 0 && there > 0 && std::abs(run.near[i] - near[i]) < kAgreement &&
                       std::abs(run.far[i] - far[i]) < kAgreement;
    if (!agree && here <= there) continue;
    const float weight = eighth_power(here);
    const float share = agree ? weight / (weight + eighth_power(there) + 1e-30F) : 1;
    near[i] = share * run.near[i] + (1 - share) * near[i];
    far[i] = share * run.far[i] + (1 - share) * far[i];
    confidence[i] = static_cast<std::uint8_t>(std::lround(255 * std::max(here, there)));
  }
}

struct Measurement {
  const LightField& light_field;
  const TensorScales& scales;
  const DoubleSearch& search;
  DoubleLayers& layers;
  int first_row = 0;  // of the layers
};

// Tiles of all camera rows (horizontal EPIs) or columns.
void run_direction(const Measurement& measurement, Direction direction, const Progress& progress) {
  const LightField& lf = measurement.light_field;
  DoubleLayers& layers = measurement.layers;
  const bool horizontal = direction == Direction::Horizontal;
  const GridShape grid = layers.near.grid();
  const ViewIndex first = layers.near.first();
  const PixelIndex tile = DoubleOrientation::tile(direction);
  const int columns = (lf.width() + tile.x - 1) / tile.x;
  const int rows = layers.near.height(), first_row = measurement.first_row;
  const int tiles = columns * ((rows + tile.y - 1) / tile.y);
  const int lines = horizontal ? grid.v : grid.u;
  parallel_for_workers(lines * tiles, progress, [&] {
    return [&, orientation = DoubleOrientation(lf, direction, measurement.scales,
                                               measurement.search)](int i) mutable {
      if (i % measurement.search.tile_stride != 0) return;
      const int line = (horizontal ? first.v : first.u) + i / tiles;
      const int row = i % tiles / columns * tile.y;
      const PixelIndex begin{first_row + row, i % tiles % columns * tile.x};
      const int first_view = horizontal ? first.u : first.v;
      const DoubleOrientation::Task task{line,
                                         begin,
                                         std::min(tile.y, rows - row),
                                         std::min(tile.x, lf.width() - begin.x),
                                         first_view,
                                         first_view + (horizontal ? grid.u : grid.v)};
      orientation.estimate(task, [&](int view, PixelIndex at, int count, const float* near,
                                     const float* far, const float* confidence) {
        const ViewIndex index = horizontal ? ViewIndex{line, view} : ViewIndex{view, line};
        const int y = at.y - first_row;
        merge({count, near, far, confidence}, layers.near.view(index).row(y) + at.x,
              layers.far.view(index).row(y) + at.x, layers.confidence.view(index).row(y) + at.x);
      });
    };
  });
}

void measure_on_device(const Measurement& measurement, const Progress& progress) {
  progress.step("two orientations");
  const DevicePasses of =
      device_passes(measurement.light_field, measurement.scales, measurement.search);
  cuda::measure_double_layers(
      measurement.light_field, of.passes, of.shears,
      {measurement.layers.near, measurement.layers.far, measurement.layers.confidence}, progress);
}

// View by view: memory of hundreds of megabytes is touched here for the first time, which takes
// longer than a stop request may wait.
void clear(DoubleLayers& layers, const Progress& progress) {
  const GridShape grid = layers.near.grid();
  const ViewIndex first = layers.near.first();
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i, first);
    std::fill_n(layers.near.view(view).data, layers.near.view_size(), 0.0F);
    std::fill_n(layers.far.view(view).data, layers.far.view_size(), 0.0F);
    std::memset(layers.confidence.view(view).data, 0, layers.confidence.view_size());
  });
}

}  // namespace

void require_double_grid(const LightField& lf) {
  if (std::max(lf.grid().u, lf.grid().v) >= DoubleOrientation::kMinViews) return;
  throw InvalidInput(
      fmt::format("two layers need at least 3 views in a row or column, but the grid is {}×{}",
                  lf.grid().v, lf.grid().u));
}

DoubleLayers measure_double_layers(const LightField& lf, const TensorScales& scales,
                                   const DoubleSearch& search, const MapBlock& block,
                                   const Progress& progress, Device device) {
  const bool has_horizontal = lf.grid().u >= DoubleOrientation::kMinViews;
  const bool has_vertical = lf.grid().v >= DoubleOrientation::kMinViews;
  require_double_grid(lf);
  DoubleLayers layers;
  const auto [first, grid] = block.views;
  layers.near = ViewStack<float>(grid, block.rows(), lf.width(), 1, first);
  layers.far = ViewStack<float>(grid, block.rows(), lf.width(), 1, first);
  layers.confidence = ViewStack<std::uint8_t>(grid, block.rows(), lf.width(), 1, first);
  if (device == Device::Cuda) {
    assert(block.rows() == lf.height());
    measure_on_device({lf, scales, search, layers}, progress);
    return layers;
  }
  clear(layers, progress.part(0, 0.01));
  const Measurement measurement{lf, scales, search, layers, block.first_row};
  const double half = !has_vertical ? 1 : has_horizontal ? 0.5 : 0.01;
  if (has_horizontal) {
    progress.step("two orientations, horizontal EPIs");
    run_direction(measurement, Direction::Horizontal, progress.part(0.01, half));
  }
  if (has_vertical) {
    progress.step("two orientations, vertical EPIs");
    run_direction(measurement, Direction::Vertical, progress.part(half, 1));
  }
  return layers;
}

DoubleNeeds double_layers_need(const LightField& lf, const TensorScales& scales,
                               const DoubleSearch& search) {
  DoubleNeeds most;
  for (const Direction direction : {Direction::Horizontal, Direction::Vertical}) {
    const bool is_horizontal = direction == Direction::Horizontal;
    if ((is_horizontal ? lf.grid().u : lf.grid().v) < DoubleOrientation::kMinViews) continue;
    const DoubleOrientation one(lf, direction, scales, search);
    most.bytes = std::max(most.bytes, one.byte_size());
    most.reach = std::max(most.reach, one.reach());
  }
  return most;
}

}  // namespace episcope
