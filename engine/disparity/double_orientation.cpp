// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/double_orientation.h"

#include "engine/core/error.h"
#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/double_orientation_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace episcope {

// The filters of double orientations over an EPI of some views, with the memory they live in.
struct DoubleFilterSet {
  SecondOrderFilters filters;               // Its weights point into the vector below.
  std::vector<float> row_weights;           // `[row][product row]`
  int first_product = 0, last_product = 0;  // Views [first, last) where derivatives exist.
};

namespace {

// Half the distance of shears and some overlap, px.
constexpr float kDoubleShearReach = 0.6F;

// Smoothing, first and second derivative of one radius. Five taps: the one set whose ratios
// h₁/h₀ = iν and h₂/h₀ = −ν² hold up to the sixth order, to 0.5 % for waves of 4 px. Three taps:
// the one set whose ratios agree, (h₁/h₀)² = h₂/h₀.
struct Matched {
  int radius;
  std::array<std::array<double, 5>, 3> values;
};
constexpr Matched kThreeTaps = {1, {{{0.25, 0.5, 0.25}, {-0.5, 0, 0.5}, {1, -2, 1}}}};
constexpr Matched kFiveTaps = {2,
                               {{{1.0 / 90, 2.0 / 9, 8.0 / 15, 2.0 / 9, 1.0 / 90},
                                 {-0.05, -0.4, 0, 0.4, 0.05},
                                 {11.0 / 60, 4.0 / 15, -0.9, 4.0 / 15, 11.0 / 60}}}};

Taps taps_of(const Matched& set, int order) {
  Taps taps;
  taps.radius = set.radius;
  for (int i = 0; i <= 2 * set.radius; ++i) {
    taps.values[i] = static_cast<float>(set.values[order][i]);
  }
  return taps;
}

Taps convolved(const Taps& a, const Taps& b) {
  Taps taps;
  taps.radius = a.radius + b.radius;
  for (int i = 0; i <= 2 * a.radius; ++i) {
    for (int j = 0; j <= 2 * b.radius; ++j) taps.values[i + j] += a.values[i] * b.values[j];
  }
  return taps;
}

double inner_product(const Taps& a, const Taps& b) {
  return std::inner_product(a.values, a.values + 2 * a.radius + 1, b.values, 0.0);
}

// What white noise of variance 1 leaves in each derivative, taken out again: the Cholesky factor of
// its covariance. Only f_xx and f_uu are correlated, the odd filters being orthogonal to the even.
void whiten(SecondOrderFilters& filters) {
  const auto covariance = [&](int i, int j) {
    return inner_product(filters.along[2 - i], filters.along[2 - j]) *
           inner_product(filters.views[i], filters.views[j]);
  };
  const double first = std::sqrt(covariance(0, 0));
  const double share = covariance(0, 2) / first;
  const double rest = std::sqrt(covariance(2, 2) - share * share);
  filters.scale[0] = static_cast<float>(1 / first);
  filters.scale[1] = static_cast<float>(1 / std::sqrt(covariance(1, 1)));
  filters.scale[2] = static_cast<float>(1 / rest);
  filters.mix = static_cast<float>(-share / (first * rest));
}

// Weights of the product rows for each view: a Gaussian, or the nearest row where it has none.
std::vector<float> integration_weights(int rows, int first, int last, double sigma) {
  const int count = last - first;
  std::vector<float> weights(static_cast<std::size_t>(rows) * count);
  for (int r = 0; r < rows; ++r) {
    float* row = &weights[static_cast<std::size_t>(r) * count];
    for (int i = 0; i < count; ++i) {
      const double off = first + i - r;
      row[i] = std::abs(off) <= std::ceil(2 * sigma)
                   ? static_cast<float>(std::exp(-0.5 * off * off / (sigma * sigma + 1e-9)))
                   : 0.0F;
    }
    const float sum = std::accumulate(row, row + count, 0.0F);
    if (sum < 1e-3F) {
      std::fill_n(row, count, 0.0F);
      row[std::clamp(r, first, last - 1) - first] = 1;
    } else {
      for (int i = 0; i < count; ++i) row[i] /= sum;
    }
  }
  return weights;
}

DoubleFilterSet make_double_filters(int rows, int channels, const TensorScales& scales) {
  const TensorFilterSet set = make_tensor_filters(rows, channels, scales);
  const Matched& views = rows < 5 ? kThreeTaps : kFiveTaps;
  DoubleFilterSet result;
  SecondOrderFilters& filters = result.filters;
  for (int order = 0; order < 3; ++order) {
    filters.along[order] = convolved(taps_of(kFiveTaps, order), set.filters.smooth);
    filters.views[order] = taps_of(views, order);
  }
  filters.integrate = set.filters.integrate;
  filters.across = set.across;
  filters.contrast_energy = set.filters.contrast_energy;
  filters.noise_energy = set.filters.noise_energy;
  whiten(filters);
  result.first_product = views.radius;
  result.last_product = rows - views.radius;
  result.row_weights =
      integration_weights(rows, result.first_product, result.last_product, scales.views);
  filters.row_weights = result.row_weights.data();
  return result;
}

// Shears: whole pixels near every mean that two accepted disparities can have.
std::vector<int> double_steps(const DoubleSearch& search) {
  const double half = 0.5 * search.min_distance;
  const int first = static_cast<int>(std::ceil(search.accepted.min + half - 0.5));
  const int last = static_cast<int>(std::floor(search.accepted.max - half + 0.5));
  std::vector<int> steps;
  for (int step = first; step <= last; ++step) steps.push_back(step);
  return steps;
}

using Direction = DoubleOrientation::Direction;

// Along and across the EPIs: planes of a tile stay in the cache.
constexpr PixelIndex kHorizontalTile = {16, 96};
constexpr PixelIndex kVerticalTile = {64, 32};
// Lanes that a kernel may touch beyond a plane, besides the neighbors it needs.
constexpr int kDoubleSlack = 64;

int views_along(const LightField& lf, Direction direction) {
  const int views = direction == Direction::Horizontal ? lf.grid().u : lf.grid().v;
  if (views < DoubleOrientation::kMinViews || views > DoubleOrientation::kMaxViews) {
    throw InvalidInput(
        fmt::format("two orientations need {} to {} views along an EPI, but the grid has {}",
                    DoubleOrientation::kMinViews, DoubleOrientation::kMaxViews, views));
  }
  return views;
}

long rounded_lanes(long lanes) {
  return (lanes + 15) / 16 * 16;
}

cuda::DoubleTaps device_taps(const Taps& taps) {
  cuda::DoubleTaps copy;
  copy.radius = taps.radius;
  std::copy_n(taps.values, 2 * taps.radius + 1, copy.values);
  return copy;
}

cuda::DoublePass device_pass(const LightField& lf, const TensorScales& scales,
                             const DoubleSearch& search, bool is_horizontal) {
  const DoubleFilterSet set =
      make_double_filters(is_horizontal ? lf.grid().u : lf.grid().v, lf.channels(), scales);
  const PixelIndex tile =
      DoubleOrientation::tile(is_horizontal ? DoubleOrientation::Direction::Horizontal
                                            : DoubleOrientation::Direction::Vertical);
  const SecondOrderFilters& filters = set.filters;
  cuda::DoublePass pass;
  pass.is_horizontal = is_horizontal;
  for (int order = 0; order < 3; ++order) {
    pass.along[order] = device_taps(filters.along[order]);
    pass.views[order] = device_taps(filters.views[order]);
    pass.scale[order] = filters.scale[order];
  }
  pass.integrate = device_taps(filters.integrate);
  pass.across = device_taps(filters.across);
  pass.mix = filters.mix;
  pass.contrast_energy = filters.contrast_energy;
  pass.noise_energy = filters.noise_energy;
  pass.first_product = set.first_product;
  pass.last_product = set.last_product;
  pass.row_weights = set.row_weights;
  pass.tile_height = tile.y;
  pass.tile_width = tile.x;
  pass.tile_stride = search.tile_stride;
  return pass;
}

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
    const bool agree = here > 0 && there > 0 &&
                       std::abs(run.near[i] - near[i]) < kDirectionAgreement &&
                       std::abs(run.far[i] - far[i]) < kDirectionAgreement;
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
void clear_layers(DoubleLayers& layers, const Progress& progress) {
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

struct DoubleOrientation::State {
  Direction direction;
  DoubleSearch search;
  SamplePlanes samples;
  const DoubleOrientationKernel& kernel =
      EPISCOPE_CHOOSE_KERNEL(best_isa(), kDoubleOrientationKernel);
  const DoubleFilterSet set;
  const SecondOrderFilters& filters = set.filters;
  const std::vector<int> steps;  // shears
  DoubleBlock block;
  int margin_x = 0, margin_y = 0;
  int plane_height = 0, plane_width = 0;
  long result_pitch = 0;
  std::vector<float> memory;
  std::vector<float> best;  // [view][near, far, confidence][y][x] of a tile

  State(const LightField& lf, Direction dir, const TensorScales& scales,
        const DoubleSearch& wanted);
  [[nodiscard]] bool horizontal() const { return direction == Direction::Horizontal; }
  void allocate();
  void gather(const Task& task);
  template <class Body>
  void each_run(const Task& task, const Body& body);
  void estimate(const Task& task, const Sink& sink);
};

DoubleOrientation::State::State(const LightField& lf, Direction dir, const TensorScales& scales,
                                const DoubleSearch& wanted)
    : direction(dir),
      search(wanted),
      samples(lf, InvalidSamples::AsNan),
      set(make_double_filters(views_along(lf, dir), lf.channels(), scales)),
      steps(double_steps(wanted)) {
  block.rows = views_along(lf, dir);
  block.channels = lf.channels();
  block.has_invalid = !lf.valid().empty();
  block.first_product = set.first_product;
  block.last_product = set.last_product;
  allocate();
}

void DoubleOrientation::State::allocate() {
  int largest = 0;
  for (const int step : steps) largest = std::max(largest, std::abs(step));
  // A view integrates over product rows, whose derivatives reach to further views: each step along
  // the views moves by the shear.
  const int margin =
      largest * (block.rows - 1) + filters.integrate.radius + filters.along[0].radius;
  margin_x = horizontal() ? margin : filters.across.radius;
  margin_y = horizontal() ? filters.across.radius : margin;
  const PixelIndex largest_tile = tile(direction);
  plane_height = largest_tile.y + 2 * margin_y;
  plane_width = largest_tile.x + 2 * margin_x;
  block.along = horizontal() ? 1 : plane_width;
  block.across = horizontal() ? plane_width : 1;
  block.lanes = static_cast<long>(plane_height) * plane_width;
  block.pitch = rounded_lanes(block.lanes + kDoubleSlack);
  result_pitch = rounded_lanes(largest_tile.x);
  const int product_rows = block.last_product - block.first_product;
  const std::size_t image = static_cast<std::size_t>(block.rows) * block.channels * block.pitch;
  const std::size_t product = static_cast<std::size_t>(product_rows) * block.pitch;
  // Lanes at the ends of the first and last plane look this far beyond.
  const std::size_t outside =
      static_cast<std::size_t>(largest + filters.along[0].radius + filters.across.radius + 8) *
          plane_width +
      block.pitch;
  memory.assign(4 * image + 6 * product + block.pitch + 2 * outside, 0.0F);
  float* next = memory.data() + outside;
  const auto take = [&next](std::size_t count) { return std::exchange(next, next + count); };
  block.samples = take(image);
  for (float*& plane : block.derivative) plane = take(image);
  for (float*& plane : block.product) plane = take(product);
  block.scratch = take(block.pitch);
  best.resize(static_cast<std::size_t>(3) * block.rows * largest_tile.y * result_pitch +
              kDoubleSlack);
}

// The tile with its margins.
void DoubleOrientation::State::gather(const Task& task) {
  const int left = task.begin.x - margin_x;
  for (int row = 0; row < block.rows; ++row) {
    const ViewIndex view =
        horizontal() ? ViewIndex{task.camera_line, row} : ViewIndex{row, task.camera_line};
    for (int i = 0; i < task.height + 2 * margin_y; ++i) {
      std::array<float*, 3> lanes{};
      for (int c = 0; c < block.channels; ++c) {
        lanes[c] = block.samples + (static_cast<long>(c) * block.rows + row) * block.pitch +
                   static_cast<long>(i) * plane_width;
      }
      samples.read_clamped(view, task.begin.y - margin_y + i, left, left + plane_width,
                           lanes.data());
    }
  }
}

// Every line of the tile in every wanted view, lines first.
template <class Body>
void DoubleOrientation::State::each_run(const Task& task, const Body& body) {
  const std::size_t plane = static_cast<std::size_t>(task.height) * result_pitch;
  for (int view = task.first_view; view < task.last_view; ++view) {
    float* const of_view = best.data() + 3 * plane * (view - task.first_view);
    for (int y = 0; y < task.height; ++y) {
      float* const near = of_view + y * result_pitch;
      body(DoubleRun{view, static_cast<long>(y + margin_y) * plane_width + margin_x, task.width,
                     near, near + plane, near + 2 * plane});
    }
  }
}

void DoubleOrientation::State::estimate(const Task& task, const Sink& sink) {
  const FlushDenormals flush;
  gather(task);
  kernel.differentiate(block, filters);
  best.assign(best.size(), 0.0F);
  for (const int step : steps) {
    kernel.accumulate(block, filters, step);
    each_run(task, [&](const DoubleRun& run) {
      kernel.select(
          block, filters,
          {step, kDoubleShearReach, static_cast<float>(search.accepted.min),
           static_cast<float>(search.accepted.max), static_cast<float>(search.min_distance)},
          run);
    });
  }
  PixelIndex at = task.begin;
  each_run(task, [&](const DoubleRun& run) {
    sink(run.row, at, task.width, run.near, run.far, run.confidence);
    at.y = at.y + 1 < task.begin.y + task.height ? at.y + 1 : task.begin.y;
  });
}

DoubleOrientation::DoubleOrientation(const LightField& light_field, Direction direction,
                                     const TensorScales& scales, const DoubleSearch& search)
    : state_(std::make_unique<State>(light_field, direction, scales, search)) {}
DoubleOrientation::~DoubleOrientation() = default;
DoubleOrientation::DoubleOrientation(DoubleOrientation&&) noexcept = default;

PixelIndex DoubleOrientation::tile(Direction direction) {
  return direction == Direction::Horizontal ? kHorizontalTile : kVerticalTile;
}

void DoubleOrientation::estimate(const Task& task, const Sink& sink) {
  state_->estimate(task, sink);
}

DevicePasses device_passes(const LightField& lf, const TensorScales& scales,
                           const DoubleSearch& search) {
  DevicePasses made;
  for (const bool is_horizontal : {true, false}) {
    const int views = is_horizontal ? lf.grid().u : lf.grid().v;
    if (views < DoubleOrientation::kMinViews) continue;
    made.passes.push_back(device_pass(lf, scales, search, is_horizontal));
  }
  made.shears = {double_steps(search), kDoubleShearReach, static_cast<float>(search.accepted.min),
                 static_cast<float>(search.accepted.max), static_cast<float>(search.min_distance)};
  return made;
}

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
  clear_layers(layers, progress.part(0, 0.01));
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

}  // namespace episcope
