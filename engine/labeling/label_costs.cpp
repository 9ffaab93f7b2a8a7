// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/label_costs.h"

#include "engine/core/parallel.h"
#include "engine/labeling/ray_targets.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace episcope {
namespace {

// What one thread sums up of one row.
struct Row {
  explicit Row(int width) : targets(width), count(width) {}
  std::vector<std::int32_t> targets;
  std::vector<std::ptrdiff_t> offsets;  // of the first layer of the rays that arrive,
  std::vector<int> columns;             // and of where they came from
  std::vector<float> count;
};

void add_view(VolumeView<const std::uint8_t> p, const CostTable& table, Row& row, float* costs) {
  row.offsets.clear();
  row.columns.clear();
  for (int x = 0; x < p.width; ++x) {
    const std::int32_t target = row.targets[x];
    if (target < 0) continue;
    const int y = target / p.width;
    row.offsets.push_back(static_cast<std::ptrdiff_t>(y) * p.layers * p.width + target -
                          static_cast<std::ptrdiff_t>(y) * p.width);
    row.columns.push_back(x);
    row.count[x] += 1;
  }
  for (int layer = 0; layer < p.layers; ++layer) {
    const std::uint8_t* const from = p.data + static_cast<std::ptrdiff_t>(layer) * p.width;
    float* const to = costs + static_cast<std::ptrdiff_t>(layer) * p.width;
    for (std::size_t i = 0; i < row.columns.size(); ++i) {
      to[row.columns[i]] += table[from[row.offsets[i]]];
    }
  }
}

void forget_known(const TrackSources& sources, int y, Row& row) {
  if (sources.known.empty()) return;
  const std::int32_t* const known = sources.known.row(y);
  for (int x = 0; x < sources.known.width; ++x) {
    if (known[x] >= 0) row.targets[x] = -1;
  }
}

void fill_row(const TrackSources& sources, const CostTable& table, VolumeView<float> costs, int y,
              Row& row) {
  const auto& [probabilities, disparity, view, known] = sources;
  const std::uint8_t* const own = probabilities.view(view).view().row(y, 0);
  float* const sums = costs.row(y, 0);
  std::transform(own, own + static_cast<std::ptrdiff_t>(costs.layers) * costs.width, sums,
                 [&table](std::uint8_t p) { return table[p]; });
  if (!known.empty() && std::all_of(known.row(y), known.row(y) + known.width,
                                    [](std::int32_t label) { return label >= 0; })) {
    return;
  }
  std::fill(row.count.begin(), row.count.end(), 1.0F);
  for (int i = 0; i < probabilities.grid.count(); ++i) {
    const ViewIndex other = probabilities.view_at(i);
    if (other == view || !disparity.contains(other)) continue;
    find_ray_targets(disparity.view(view), disparity.view(other),
                     {other.v - view.v, other.u - view.u}, y, row.targets.data());
    forget_known(sources, y, row);
    add_view(probabilities.view(other).view(), table, row, sums);
  }
  for (int layer = 0; layer < costs.layers; ++layer) {
    float* const sum = costs.row(y, layer);
    for (int x = 0; x < costs.width; ++x) sum[x] /= row.count[x];
  }
}

}  // namespace

CostTable cost_table(double floor) {
  CostTable table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = static_cast<float>(-std::log(std::max(static_cast<double>(i) / 255, floor)));
  }
  return table;
}

void fill_costs(VolumeView<const std::uint8_t> probabilities, const CostTable& table,
                VolumeView<float> costs) {
  std::transform(probabilities.data, probabilities.data + probabilities.size(), costs.data,
                 [&table](std::uint8_t p) { return table[p]; });
}

void fill_track_costs(const TrackSources& sources, const CostTable& table, const Progress& progress,
                      VolumeView<float> costs) {
  const auto make_worker = [&]() -> std::function<void(int)> {
    auto row = std::make_shared<Row>(costs.width);
    return [&, row](int y) { fill_row(sources, table, costs, y, *row); };
  };
  parallel_for_workers(costs.height, progress, make_worker);
}

}  // namespace episcope
