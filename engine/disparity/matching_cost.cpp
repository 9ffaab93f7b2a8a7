// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/matching_cost.h"

#include "engine/core/error.h"
#include "engine/core/isa.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/matching_kernel.h"
#include "engine/disparity/view_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace episcope {
namespace {

// Shifts this near to whole pixels are taken as whole.
constexpr double kWhole = 1e-5;

AxisShift make_shift(double shift, int extent, Interpolation interpolation) {
  AxisShift result;
  const double whole = std::floor(shift + kWhole);
  const double t = shift - whole;
  result.origin = static_cast<int>(whole);
  result.nearest = result.origin + (t > 0.5 ? 1 : 0);
  result.first = std::clamp(static_cast<int>(std::ceil(-shift - kWhole)), 0, extent);
  result.last =
      std::clamp(static_cast<int>(std::floor(extent - 1 - shift + kWhole)) + 1, 0, extent);
  if (std::abs(t) <= kWhole) return result;
  if (interpolation == Interpolation::Bilinear) {
    result.taps = 2;
    result.weights = {static_cast<float>(1 - t), static_cast<float>(t)};
    return result;
  }
  // Catmull-Rom: through the samples, exact for parabolas.
  result.taps = 4;
  result.origin -= 1;
  result.weights = {static_cast<float>(t * (-0.5 + t * (1 - 0.5 * t))),
                    static_cast<float>(1 + t * t * (-2.5 + 1.5 * t)),
                    static_cast<float>(t * (0.5 + t * (2 - 1.5 * t))),
                    static_cast<float>(t * t * (-0.5 + 0.5 * t))};
  return result;
}

// The pixels of one axis that a point at `place` covers, within [0, extent).
struct Covered {
  int first = 0, last = 0;
};

Covered covered(float place, int extent) {
  const int whole = static_cast<int>(std::floor(place));
  const float t = place - static_cast<float>(whole);
  const int first = t > 1 - kSurfaceOverlap ? whole + 1 : whole;
  const int last = t < kSurfaceOverlap ? whole : whole + 1;
  return {std::max(first, 0), std::min(last, extent - 1)};
}

void cast_row(ImageView<const float> disparity, int y, ViewIndex step, ImageView<float> out) {
  for (int x = 0; x < disparity.width; ++x) {
    const float d = disparity.at(y, x);
    if (d <= kNothingNear) continue;
    const Covered rows =
        covered(static_cast<float>(y) - d * static_cast<float>(step.v), out.height);
    const Covered columns =
        covered(static_cast<float>(x) - d * static_cast<float>(step.u), out.width);
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        out.at(row, column) = std::max(out.at(row, column), d);
      }
    }
  }
}

// A tile's costs of all labels (256 KiB) and the samples of one view stay in the L2 cache.
constexpr int kTileColumns = 128;
constexpr int kTileRows = 8;
constexpr int kTileLayers = 512;
// Labels whose samples lie within so many pixels share what is read of a view.
constexpr int kSampleSpread = 24;

int rounded_up(int lanes) {
  return (lanes + kMatchingSlack - 1) / kMatchingSlack * kMatchingSlack;
}

void check(const LightField& lf, ViewIndex reference, const MatchingCost& cost,
           const std::vector<float>& labels) {
  check_matching(lf, reference);
  if (labels.empty()) throw InvalidInput("stereo needs at least one label");
  if (cost.places && std::ssize(*cost.places) != lf.grid().count()) {
    throw InvalidInput("stereo needs the place of every view, or of none");
  }
  if (!(cost.cap > 0)) throw InvalidInput("the cap of the matching cost must be positive");
}

// Means of `counts` costs each; the worst where there is none.
void divide(const float* sums, const float* counts, const float* worst, std::span<float> out) {
  for (std::size_t x = 0; x < out.size(); ++x) {
    out[x] = counts[x] > 0 ? sums[x] / counts[x] : worst[x];
  }
}

}  // namespace

std::vector<double> regular_ways(int places, int reference) {
  std::vector<double> ways(places);
  std::iota(ways.begin(), ways.end(), -reference);
  return ways;
}

std::vector<double> stated_ways(const std::vector<ViewPlace>& places, std::size_t reference,
                                double ViewPlace::*axis) {
  std::vector<double> ways;
  ways.reserve(places.size());
  for (const ViewPlace& place : places) ways.push_back(place.*axis - places[reference].*axis);
  return ways;
}

std::vector<AxisShift> make_shifts(const std::vector<double>& ways, int extent,
                                   Interpolation interpolation, const std::vector<float>& labels) {
  std::vector<AxisShift> shifts;
  for (const double way : ways) {
    for (const float label : labels) {
      // u and v grow against the motion of points.
      const double shift = -label * way;
      shifts.push_back(make_shift(shift, extent, interpolation));
    }
  }
  return shifts;
}

std::vector<float> count_seen(const std::vector<AxisShift>& shifts, int labels, int extent) {
  std::vector<float> seen(static_cast<std::size_t>(labels) * extent, 0.0F);
  // How many more views see a pixel than the one before it, and then their sums.
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    if (shifts[i].first >= shifts[i].last) continue;
    float* row = seen.data() + i % labels * extent;
    row[shifts[i].first] += 1;
    if (shifts[i].last < extent) row[shifts[i].last] -= 1;
  }
  for (int label = 0; label < labels; ++label) {
    float* row = seen.data() + static_cast<std::size_t>(label) * extent;
    std::partial_sum(row, row + extent, row);
  }
  return seen;
}

ViewStack<float> surfaces_in_views(ImageView<const float> disparity, ViewIndex reference,
                                   GridShape grid, const Progress& progress) {
  ViewStack<float> surfaces(grid, disparity.height, disparity.width);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i);
    const ImageView<float> out = surfaces.view(view);
    std::fill_n(out.data, out.size(), kNothingNear);
    for (int y = 0; y < disparity.height; ++y) {
      cast_row(disparity, y, {view.v - reference.v, view.u - reference.u}, out);
    }
  });
  return surfaces;
}

Names<Interpolation> names_of(Interpolation) {
  return {{Interpolation::Cubic, "cubic"}, {Interpolation::Bilinear, "bilinear"}};
}

void check_matching(const LightField& lf, ViewIndex reference) {
  if (!lf.grid().contains(reference)) {
    throw InvalidInput(
        fmt::format("there is no view {}: the grid has {}×{} views, counted from 0,0",
                    view_text(reference), lf.grid().v, lf.grid().u));
  }
  if (lf.grid().count() == 1) {
    throw InvalidInput("stereo needs at least 2 views, but this light field has only 1");
  }
}

struct MatchingCostRows::State {
  // The part of the reference view that is worked on.
  struct Tile {
    int y = 0, x = 0;
    int rows = 0, columns = 0;
  };
  // Samples of a view around the tile, for neighboring labels.
  struct Window {
    int y = 0, x = 0;  // Offset of its first sample from the tile's first pixel.
    int rows = 0, columns = 0;
  };

  const LightField& light_field;
  ViewIndex reference;
  MatchingCost cost;
  std::vector<float> disparities;
  int labels = 0;
  SamplePlanes planes;
  const MatchingKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kMatchingKernel);
  std::vector<AxisShift> row_shifts, column_shifts;
  std::vector<float> rows_seen, columns_seen;

  int tile_rows = 0;
  int reference_pitch = 0, sample_pitch = 0, cost_pitch = 0;
  std::vector<float> reference_samples, noise, samples, lines, sums;
  std::vector<float> counts;         // Of the views in each sum; empty: all samples count.
  std::vector<float> caps, nearest;  // Beside counts only.

  State(const LightField& lf, ViewIndex view, const MatchingCost& wanted,
        const std::vector<float>& disparities);
  void find_shifts();
  void read_reference(const Tile& tile);
  void add_view(const Tile& tile, ViewIndex view);
  [[nodiscard]] float largest_cost() const {
    return static_cast<float>(
        std::min(cost.cap, std::sqrt(static_cast<double>(light_field.channels()))));
  }
  [[nodiscard]] bool weighs() const { return cost.caps || cost.occluders; }
  void read_nearest(const Tile& tile, const Window& window, ViewIndex view);
  void add_occluders(const Window& window, ViewIndex view, int label, MatchingTile& work) const;
  [[nodiscard]] bool sees(const Tile& tile, ViewIndex view, int label) const;
  [[nodiscard]] Window extend(const Window& window, ViewIndex view, int label) const;
  void read_window(const Tile& tile, const Window& window, ViewIndex view);
  void add_label(const Tile& tile, const Window& window, ViewIndex view, int label);
  void finish(const Tile& tile, int y, VolumeView<float> costs) const;
  [[nodiscard]] const AxisShift& row_shift(ViewIndex view, int label) const {
    return row_shifts[(cost.places ? index_of(view) : view.v) * labels + label];
  }
  [[nodiscard]] const AxisShift& column_shift(ViewIndex view, int label) const {
    return column_shifts[(cost.places ? index_of(view) : view.u) * labels + label];
  }
  [[nodiscard]] std::size_t index_of(ViewIndex view) const {
    return static_cast<std::size_t>(view.v) * light_field.grid().u + view.u;
  }
};

MatchingCostRows::State::State(const LightField& lf, ViewIndex view, const MatchingCost& wanted,
                               const std::vector<float>& wanted_labels)
    : light_field(lf),
      reference(view),
      cost(wanted),
      disparities(wanted_labels),
      labels(static_cast<int>(disparities.size())),
      planes(lf, InvalidSamples::AsNan) {
  check(lf, view, wanted, disparities);
  find_shifts();
  tile_rows = std::clamp(kTileLayers / labels, 1, kTileRows);
  cost_pitch = kTileColumns;
  reference_pitch = kTileColumns + kMatchingSlack;
  sample_pitch = rounded_up(kTileColumns + kSampleSpread + kMaxShiftTaps) + kMatchingSlack;
  const auto channels = static_cast<std::size_t>(lf.channels());
  reference_samples.resize(channels * tile_rows * reference_pitch + kMatchingSlack);
  noise.resize(static_cast<std::size_t>(tile_rows) * reference_pitch + kMatchingSlack);
  const std::size_t sample_rows = tile_rows + kSampleSpread + kMaxShiftTaps;
  samples.resize(channels * sample_rows * sample_pitch + kMatchingSlack);
  lines.resize(channels * sample_pitch + kMatchingSlack);
  sums.resize(static_cast<std::size_t>(tile_rows) * labels * cost_pitch + kMatchingSlack);
  if (lf.valid().empty() && !cost.places && !weighs()) return;
  counts.resize(sums.size());
  caps.assign(static_cast<std::size_t>(tile_rows) * reference_pitch + kMatchingSlack,
              largest_cost());
  nearest.assign(sample_rows * sample_pitch + kMatchingSlack, kNothingNear);
}

void MatchingCostRows::State::find_shifts() {
  const GridShape grid = light_field.grid();
  const int height = light_field.height(), width = light_field.width();
  const auto ways = [&](int places, int at, double ViewPlace::*axis) {
    return cost.places ? stated_ways(*cost.places, index_of(reference), axis)
                       : regular_ways(places, at);
  };
  row_shifts = make_shifts(ways(grid.v, reference.v, &ViewPlace::v), height, cost.interpolation,
                           disparities);
  column_shifts =
      make_shifts(ways(grid.u, reference.u, &ViewPlace::u), width, cost.interpolation, disparities);
  if (cost.places) return;
  rows_seen = count_seen(row_shifts, labels, height);
  columns_seen = count_seen(column_shifts, labels, width);
}

void MatchingCostRows::State::read_reference(const Tile& tile) {
  for (int y = 0; y < tile.rows; ++y) {
    std::array<float*, 3> out{};
    for (int c = 0; c < light_field.channels(); ++c) {
      out[c] = reference_samples.data() +
               (static_cast<std::size_t>(c) * tile_rows + y) * reference_pitch;
    }
    planes.read(reference, tile.y + y, tile.x, tile.x + tile.columns, out.data());
    const std::size_t at = static_cast<std::size_t>(y) * reference_pitch;
    if (cost.noise) {
      std::copy_n(cost.noise->row(tile.y + y) + tile.x, tile.columns, noise.data() + at);
    }
    if (cost.caps) {
      std::copy_n(cost.caps->row(tile.y + y) + tile.x, tile.columns, caps.data() + at);
    }
  }
}

bool MatchingCostRows::State::sees(const Tile& tile, ViewIndex view, int label) const {
  const AxisShift& rows = row_shift(view, label);
  const AxisShift& columns = column_shift(view, label);
  return rows.first < tile.y + tile.rows && rows.last > tile.y &&
         columns.first < tile.x + tile.columns && columns.last > tile.x;
}

// The window with the samples of one more label; rows and columns here are beyond those of a tile.
MatchingCostRows::State::Window MatchingCostRows::State::extend(const Window& window,
                                                                ViewIndex view, int label) const {
  const AxisShift& row = row_shift(view, label);
  const AxisShift& column = column_shift(view, label);
  if (window.rows == 0) return {row.origin, column.origin, row.taps, column.taps};
  Window wider;
  wider.y = std::min(window.y, row.origin);
  wider.x = std::min(window.x, column.origin);
  wider.rows = std::max(window.y + window.rows, row.origin + row.taps) - wider.y;
  wider.columns = std::max(window.x + window.columns, column.origin + column.taps) - wider.x;
  return wider;
}

void MatchingCostRows::State::read_window(const Tile& tile, const Window& window, ViewIndex view) {
  const int rows = tile.rows + window.rows - 1;
  const int columns = tile.columns + window.columns - 1;
  for (int y = 0; y < rows; ++y) {
    std::array<float*, 3> out{};
    for (int c = 0; c < light_field.channels(); ++c) {
      const std::size_t row =
          static_cast<std::size_t>(c) * (tile_rows + kSampleSpread + kMaxShiftTaps) + y;
      out[c] = samples.data() + row * sample_pitch;
    }
    const int x = tile.x + window.x;
    planes.read_clamped(view, tile.y + window.y + y, x, x + columns, out.data());
  }
  if (cost.occluders) read_nearest(tile, window, view);
}

void MatchingCostRows::State::read_nearest(const Tile& tile, const Window& window, ViewIndex view) {
  const ImageView<const float> surface = cost.occluders->nearest.view(view);
  const int rows = tile.rows + window.rows - 1, columns = tile.columns + window.columns - 1;
  for (int y = 0; y < rows; ++y) {
    const float* const row = surface.row(std::clamp(tile.y + window.y + y, 0, surface.height - 1));
    float* const out = nearest.data() + static_cast<std::size_t>(y) * sample_pitch;
    const int first = tile.x + window.x;
    for (int x = 0; x < columns; ++x) out[x] = row[std::clamp(first + x, 0, surface.width - 1)];
  }
}

void MatchingCostRows::State::add_occluders(const Window& window, ViewIndex view, int label,
                                            MatchingTile& work) const {
  work.caps = caps.data();
  work.nearest = nearest.data();
  work.limit = 1;
  work.steepness = 1;
  if (!cost.occluders) return;
  const int y = row_shift(view, label).nearest - window.y;
  const int x = column_shift(view, label).nearest - window.x;
  work.nearest += static_cast<std::ptrdiff_t>(y) * sample_pitch + x;
  const Occluders& occluders = *cost.occluders;
  work.limit = disparities[label] + occluders.tolerance + occluders.softness;
  work.steepness = 1 / occluders.softness;
}

void MatchingCostRows::State::add_label(const Tile& tile, const Window& window, ViewIndex view,
                                        int label) {
  const AxisShift& row = row_shift(view, label);
  const AxisShift& column = column_shift(view, label);
  MatchingTile work;
  work.channels = light_field.channels();
  work.rows = tile.rows;
  work.columns = tile.columns;
  work.first_row = std::clamp(row.first - tile.y, 0, tile.rows);
  work.last_row = std::clamp(row.last - tile.y, 0, tile.rows);
  work.first_column = std::clamp(column.first - tile.x, 0, tile.columns);
  work.last_column = std::clamp(column.last - tile.x, 0, tile.columns);
  work.reference_pitch = reference_pitch;
  work.sample_pitch = sample_pitch;
  for (int c = 0; c < work.channels; ++c) {
    const std::size_t plane =
        static_cast<std::size_t>(c) * (tile_rows + kSampleSpread + kMaxShiftTaps);
    work.reference[c] =
        reference_samples.data() + static_cast<std::size_t>(c) * tile_rows * reference_pitch;
    work.samples[c] = samples.data() + (plane + (row.origin - window.y)) * sample_pitch +
                      (column.origin - window.x);
  }
  work.row_taps = row.taps;
  work.column_taps = column.taps;
  std::copy(row.weights.begin(), row.weights.end(), work.row_weights);
  std::copy(column.weights.begin(), column.weights.end(), work.column_weights);
  work.lines = lines.data();
  work.line_pitch = sample_pitch;
  const double lost = 1 - row.noise_left() * column.noise_left();
  work.noise = noise.data();
  work.noise_lost = static_cast<float>(work.channels * std::max(lost, 0.0));
  work.cap = static_cast<float>(cost.cap);
  work.costs = sums.data() + static_cast<std::size_t>(label) * cost_pitch;
  if (!counts.empty()) {
    work.seen = counts.data() + static_cast<std::size_t>(label) * cost_pitch;
  }
  work.cost_pitch = static_cast<long>(labels) * cost_pitch;
  if (weighs()) add_occluders(window, view, label, work);
  kernel.add(work);
}

void MatchingCostRows::State::add_view(const Tile& tile, ViewIndex view) {
  int label = 0;
  while (label < labels) {
    if (!sees(tile, view, label)) {
      ++label;
      continue;
    }
    Window window;
    int end = label;
    for (; end < labels && sees(tile, view, end); ++end) {
      const Window wider = extend(window, view, end);
      if (std::max(wider.rows, wider.columns) > kSampleSpread + kMaxShiftTaps) break;
      window = wider;
    }
    read_window(tile, window, view);
    for (; label < end; ++label) add_label(tile, window, view, label);
  }
}

// Sums to means over the views that see the pixel.
void MatchingCostRows::State::finish(const Tile& tile, int y, VolumeView<float> costs) const {
  const float worst = largest_cost();
  const bool cross = cost.views == MatchedViews::CrossHair;
  for (int row = 0; row < tile.rows; ++row) {
    for (int label = 0; label < labels; ++label) {
      const std::size_t first = (static_cast<std::size_t>(row) * labels + label) * cost_pitch;
      const float* sum = sums.data() + first;
      float* out = costs.row(y + row, label) + tile.x;
      if (!counts.empty()) {
        divide(sum, counts.data() + first, caps.data() + row * reference_pitch,
               std::span(out, tile.columns));
        continue;
      }
      const float* columns =
          columns_seen.data() + static_cast<std::size_t>(label) * light_field.width() + tile.x;
      const float rows =
          rows_seen[static_cast<std::size_t>(label) * light_field.height() + tile.y + row];
      for (int x = 0; x < tile.columns; ++x) {
        const float views = cross ? columns[x] + rows - 2 : columns[x] * rows - 1;
        out[x] = views > 0 ? sum[x] / views : worst;
      }
    }
  }
}

MatchingCostRows::MatchingCostRows(const LightField& light_field, ViewIndex reference,
                                   const MatchingCost& cost, const std::vector<float>& labels)
    : state_(std::make_unique<State>(light_field, reference, cost, labels)) {}
MatchingCostRows::~MatchingCostRows() = default;
MatchingCostRows::MatchingCostRows(MatchingCostRows&&) noexcept = default;

void MatchingCostRows::compute(int y, VolumeView<float> costs, const Progress& progress) {
  State& s = *state_;
  const GridShape grid = s.light_field.grid();
  for (int row = 0; row < costs.height; row += s.tile_rows) {
    for (int x = 0; x < costs.width; x += kTileColumns) {
      progress.check();
      const State::Tile tile{y + row, x, std::min(s.tile_rows, costs.height - row),
                             std::min(kTileColumns, costs.width - x)};
      s.read_reference(tile);
      std::fill(s.sums.begin(), s.sums.end(), 0.0F);
      std::fill(s.counts.begin(), s.counts.end(), 0.0F);
      for (int v = 0; v < grid.v; ++v) {
        for (int u = 0; u < grid.u; ++u) {
          const bool on_cross = v == s.reference.v || u == s.reference.u;
          if (ViewIndex{v, u} == s.reference) continue;
          if (s.cost.views == MatchedViews::CrossHair && !on_cross) continue;
          s.add_view(tile, {v, u});
        }
      }
      s.finish(tile, row, costs);
    }
  }
}

Volume<float> matching_costs(const LightField& lf, ViewIndex reference, const MatchingCost& cost,
                             const std::vector<float>& labels, const Progress& progress) {
  check(lf, reference, cost, labels);
  Volume<float> volume(lf.height(), static_cast<int>(labels.size()), lf.width());
  const VolumeView<float> view = volume.view();
  const int bands = (lf.height() + kTileRows - 1) / kTileRows;
  parallel_for_workers(bands, progress, [&] {
    return [&, rows = MatchingCostRows(lf, reference, cost, labels)](int i) mutable {
      const int y = i * kTileRows;
      rows.compute(y,
                   {view.row(y, 0), std::min(kTileRows, view.height - y), view.layers, view.width},
                   progress);
    };
  });
  return volume;
}

std::vector<float> equidistant_labels(Interval range, int count) {
  std::vector<float> labels;
  for (int i = 0; i < count; ++i) {
    const double share = count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
    labels.push_back(static_cast<float>(range.min + share * range.length()));
  }
  return labels;
}

}  // namespace episcope
