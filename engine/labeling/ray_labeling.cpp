// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_labeling.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/scene.h"
#include "engine/labeling/ray_kernel.h"
#include "engine/solvers/layered_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace episcope {

double RayLabeling::relative_gap() const {
  return labeling_gap(energy, bound);
}

RayLabeling unlabeled(const LabelProbabilities& p) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>(p.grid, p.views[0].height(), p.views[0].width(), 1, p.first);
  return result;
}

RayLabeling unlabeled(const LabelProbabilities& p, ViewIndex view) {
  RayLabeling result;
  result.labels =
      ViewStack<std::int32_t>({1, 1}, p.view(view).height(), p.view(view).width(), 1, view);
  return result;
}

Image<std::int32_t> painted_layers(const RayLabelingInput& input, ViewIndex view) {
  if (input.strokes == nullptr) return {};
  const auto& views = input.strokes->views;
  const auto found = std::ranges::find(views, view, &ViewScribbles::view);
  if (found == views.end()) return {};
  Image<std::int32_t> layers(found->labels.height(), found->labels.width());
  const std::vector<std::int32_t>& ids = input.probabilities->ids;
  std::ranges::transform(found->labels, layers.begin(), [&](std::int32_t id) {
    const auto place = id > 0 ? std::ranges::find(ids, id) : ids.end();
    return place == ids.end() ? -1 : static_cast<std::int32_t>(place - ids.begin());
  });
  return layers;
}

float price_of_held(double smoothness) {
  return static_cast<float>(8 * smoothness + 8);
}

void hold_painted(const Image<std::int32_t>& painted, float price, VolumeView<float> costs) {
  for (int y = 0; y < painted.height(); ++y) {
    for (int x = 0; x < painted.width(); ++x) {
      if (painted.at(y, x) < 0) continue;
      for (int l = 0; l < costs.layers; ++l) costs.row(y, l)[x] = price;
      costs.row(y, painted.at(y, x))[x] = 0;
    }
  }
}

void keep_painted(const Image<std::int32_t>& painted, ImageView<std::int32_t> layers) {
  for (std::size_t i = 0; i < painted.size(); ++i) {
    if (painted.data()[i] >= 0) layers.data[i] = painted.data()[i];
  }
}

namespace {

// What one thread sums up of one row.
struct CostRow {
  explicit CostRow(int width) : targets(width), trusts(width), weight(width) {}
  std::vector<std::int32_t> targets;
  std::vector<float> trusts;  // How much each ray is trusted, 0 where it arrives nowhere,
  std::vector<float> weight;  // and of all views, by column.
  std::vector<ColumnRange> wanted;
};

void find_rays(const TrackSources& sources, ViewIndex other, int y, CostRow& row) {
  const RayColors* const colors = sources.colors;
  for (const ColumnRange columns : row.wanted) {
    find_ray_targets(sources.disparity.view(sources.view), sources.disparity.view(other),
                     {other.v - sources.view.v, other.u - sources.view.u}, y, columns,
                     row.targets.data());
    if (colors != nullptr) {
      colors->trusts(colors->pair(sources.view, y, other), columns, row.targets.data(),
                     row.trusts.data());
    }
    for (int x = columns.begin; x < columns.end; ++x) {
      if (colors == nullptr) row.trusts[x] = row.targets[x] < 0 ? 0.0F : 1.0F;
      row.weight[x] += row.trusts[x];
    }
  }
}

void add_view(VolumeView<const std::uint8_t> p, const CostTable& table, const CostRow& row,
              float* costs) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayCosts rays;
  rays.codes = p.data;
  rays.size = static_cast<long>(p.size());
  rays.table = table.data();
  rays.labels = p.layers;
  rays.width = p.width;
  rays.targets = row.targets.data();
  rays.trusts = row.trusts.data();
  kernel.add_costs(rays, costs);
}

// Whether `at` of `count` places is among those nearest to `here`, as many at the border.
bool is_near(int at, int here, int count) {
  const int first = std::clamp(here - kNearViews / 2, 0, std::max(count - kNearViews, 0));
  return at >= first && at < first + kNearViews;
}

bool are_near(ViewRectangle views, ViewIndex view, ViewIndex other) {
  const auto& [v, u] = views.first;
  return is_near(other.v - v, view.v - v, views.grid.v) &&
         is_near(other.u - u, view.u - u, views.grid.u);
}

bool is_asked(const TrackSources& sources, ViewIndex other) {
  const ViewIndex view = sources.view;
  if (other == view || !sources.disparity.contains(other)) return false;
  if (sources.others == TrackViews::All) return true;
  return are_near({sources.probabilities.first, sources.probabilities.grid}, view, other);
}

void fill_row(const TrackSources& sources, const CostTable& table, VolumeView<float> costs, int y,
              CostRow& row) {
  const LabelProbabilities& probabilities = sources.probabilities;
  row.wanted = {{0, costs.width}};
  if (!sources.wanted.empty()) row.wanted = marked_columns(sources.wanted.row(y), costs.width);
  if (row.wanted.empty()) return;
  std::ranges::fill(row.trusts, 0.0F);
  const std::uint8_t* const own = probabilities.view(sources.view).view().row(y, 0);
  float* const sums = costs.row(y, 0);
  std::transform(own, own + static_cast<std::ptrdiff_t>(costs.layers) * costs.width, sums,
                 [&table](std::uint8_t p) { return table[p]; });
  std::fill(row.weight.begin(), row.weight.end(), 1.0F);
  for (int i = 0; i < probabilities.grid.count(); ++i) {
    const ViewIndex other = probabilities.view_at(i);
    if (!is_asked(sources, other)) continue;
    find_rays(sources, other, y, row);
    add_view(probabilities.view(other).view(), table, row, sums);
  }
  for (int layer = 0; layer < costs.layers; ++layer) {
    float* const sum = costs.row(y, layer);
    for (int x = 0; x < costs.width; ++x) sum[x] /= row.weight[x];
  }
}

// A row of fewer rays than the widest vector has lanes, with rays beside it that arrive nowhere.
void find_few_targets(const RayKernel& kernel, RayRow rays, std::int32_t* targets) {
  float disparity[kRayColumns];
  std::uint8_t valid[kRayColumns] = {};
  std::int32_t found[kRayColumns];
  std::fill_n(disparity, kRayColumns, std::numeric_limits<float>::quiet_NaN());
  std::copy_n(rays.disparity, rays.end, disparity);
  if (rays.valid != nullptr) {
    std::copy_n(rays.valid, rays.end, valid);
    rays.valid = valid;
  }
  const int count = rays.end;
  rays.disparity = disparity;
  rays.end = kRayColumns;
  kernel.find_targets(rays, found);
  std::copy_n(found, count, targets);
}

constexpr float kSigma = 10;  // of 255

void store_view(const LightField& lf, ViewIndex view, ImageView<std::uint8_t> colors) {
  std::vector<float> row(static_cast<std::size_t>(colors.width) * colors.channels);
  for (int y = 0; y < colors.height; ++y) {
    lf.read_row(view, y, 0, colors.width, row.data());
    std::transform(row.begin(), row.end(), colors.row(y), [](float sample) {
      return static_cast<std::uint8_t>(std::clamp(sample, 0.0F, 1.0F) * 255 + 0.5F);
    });
  }
}

std::unique_ptr<const ViewStack<std::uint8_t>> rounded_views(const LightField& lf, GridShape grid,
                                                             ViewIndex first,
                                                             const Progress& progress) {
  auto colors = std::make_unique<ViewStack<std::uint8_t>>(grid, lf.height(), lf.width(),
                                                          lf.channels(), first);
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = grid.view_at(i, first);
    store_view(lf, view, colors->view(view));
  });
  return colors;
}

}  // namespace

std::vector<ColumnRange> marked_columns(const std::uint8_t* marks, int width) {
  std::vector<ColumnRange> found;
  for (int x = 0; x < width; x += kRayColumns) {
    const int end = std::min(x + kRayColumns, width);
    // Without an early end the compiler takes all of them at once.
    if (std::accumulate(marks + x, marks + end, std::uint8_t{0}, std::bit_or<std::uint8_t>()) == 0)
      continue;
    if (found.empty() || found.back().end < x) found.push_back({x, x});
    found.back().end = end;
  }
  // At the border there may be too few columns.
  if (!found.empty()) {
    ColumnRange& last = found.back();
    last.begin = std::max(std::min(last.begin, last.end - kRayColumns), 0);
  }
  return found;
}

std::vector<ViewIndex> near_views(ViewRectangle views, ViewIndex view) {
  std::vector<ViewIndex> near;
  for (int i = 0; i < views.grid.count(); ++i) {
    const ViewIndex other = views.grid.view_at(i, views.first);
    if (other != view && are_near(views, view, other)) near.push_back(other);
  }
  return near;
}

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
  parallel_for_workers(costs.height, progress, [&] {
    return
        [&, row = CostRow(costs.width)](int y) mutable { fill_row(sources, table, costs, y, row); };
  });
}

Image<float> larger_edge_probability(ImageView<const float> edge_probability) {
  const auto& edge = edge_probability;
  Image<float> larger(edge.height, edge.width);
  for (int y = 0; y < edge.height; ++y) {
    for (int x = 0; x < edge.width; ++x) {
      larger.at(y, x) = std::max(edge.at(y, x), edge.at(y, x, edge.channels - 1));
    }
  }
  return larger;
}

Image<float> boundary_weights(ImageView<const float> edge_probability) {
  Image<float> weights = larger_edge_probability(edge_probability);
  for (float& weight : weights) weight = std::clamp(1 - weight, kMinBoundaryWeight, 1.0F);
  return weights;
}

Image<float> boundary_weights_of(const RayLabelingInput& input, ViewIndex view) {
  if (input.edges == nullptr || input.edges->empty() || !input.edges->contains(view)) return {};
  return boundary_weights(input.edges->view(view));
}

std::vector<Image<float>> boundary_weights_of(const RayLabelingInput& input,
                                              const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  std::vector<Image<float>> weights(p.views.size());
  parallel_for(p.grid.count(), progress,
               [&](int i) { weights[i] = boundary_weights_of(input, p.view_at(i)); });
  return weights;
}

LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids, ViewRectangle views) {
  LabelProbabilities probabilities;
  probabilities.ids = ids;
  probabilities.grid = views.grid;
  probabilities.first = views.first;
  probabilities.views.resize(static_cast<std::size_t>(views.grid.count()));
  return probabilities;
}

Image<std::int32_t> most_probable_labels(VolumeView<const std::uint8_t> probabilities,
                                         const std::vector<std::int32_t>& ids) {
  if (static_cast<int>(ids.size()) != probabilities.layers) {
    throw InvalidInput(fmt::format("there are {} label ids for {} layers of probabilities",
                                   ids.size(), probabilities.layers));
  }
  Image<std::int32_t> labels(probabilities.height, probabilities.width);
  std::vector<std::uint8_t> best(probabilities.width);
  for (int y = 0; y < probabilities.height; ++y) {
    std::int32_t* out = labels.row(y);
    const std::uint8_t* first = probabilities.row(y, 0);
    best.assign(first, first + probabilities.width);
    std::fill_n(out, probabilities.width, ids[0]);
    for (int layer = 1; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] <= best[x]) continue;
        best[x] = p[x];
        out[x] = ids[layer];
      }
    }
  }
  return labels;
}

void find_layers(ImageView<const std::int32_t> labels, const std::vector<std::int32_t>& ids,
                 ImageView<std::int32_t> layers) {
  std::int32_t last = ids.front(), layer = 0;
  std::transform(labels.data, labels.data + labels.size(), layers.data, [&](std::int32_t id) {
    if (id == last) return layer;
    const auto found = std::ranges::lower_bound(ids, id);
    last = id;
    layer = found == ids.end() || *found != id ? 0 : static_cast<std::int32_t>(found - ids.begin());
    return layer;
  });
}

Image<float> label_uncertainty(VolumeView<const std::uint8_t> probabilities) {
  Image<float> uncertainty(probabilities.height, probabilities.width);
  if (probabilities.layers < 2) return uncertainty;
  const float full = std::log(static_cast<float>(probabilities.layers));
  std::vector<float> sum(probabilities.width);
  std::vector<float> sum_log(probabilities.width);  // of p log p
  for (int y = 0; y < probabilities.height; ++y) {
    std::fill(sum.begin(), sum.end(), 0.F);
    std::fill(sum_log.begin(), sum_log.end(), 0.F);
    for (int layer = 0; layer < probabilities.layers; ++layer) {
      const std::uint8_t* p = probabilities.row(y, layer);
      for (int x = 0; x < probabilities.width; ++x) {
        if (p[x] == 0) continue;
        sum[x] += p[x];
        sum_log[x] += p[x] * std::log(static_cast<float>(p[x]));
      }
    }
    for (int x = 0; x < probabilities.width; ++x) {
      // Of p over its sum s: H = log s − (Σ p log p) / s; nothing known at all is full entropy.
      const float entropy = sum[x] > 0 ? std::log(sum[x]) - sum_log[x] / sum[x] : full;
      uncertainty.at(y, x) = std::fmin(std::fmax(entropy / full, 0.F), 1.F);
    }
  }
  return uncertainty;
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      std::int32_t* targets) {
  find_ray_targets(from, to, step, y, {0, from.disparity.width}, targets);
}

void find_ray_targets(const DisparityView& from, const DisparityView& to, ViewIndex step, int y,
                      ColumnRange columns, std::int32_t* targets) {
  static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
  RayRow rays;
  rays.height = from.disparity.height;
  rays.width = from.disparity.width;
  rays.begin = columns.begin;
  rays.end = columns.end;
  rays.row = static_cast<float>(y);
  rays.step_x = static_cast<float>(step.u);
  rays.step_y = static_cast<float>(step.v);
  rays.disparity = from.disparity.row(y);
  rays.valid = from.valid.empty() ? nullptr : from.valid.row(y);
  rays.there = to.disparity.data;
  rays.valid_there = to.valid.empty() ? nullptr : to.valid.data;
  rays.tolerance = kSamePointTolerance_px;
  if (rays.width < kRayColumns) return find_few_targets(kernel, rays, targets);
  kernel.find_targets(rays, targets);
}

RayColors::RayColors(const LightField& light_field, GridShape grid, ViewIndex first,
                     const Progress& progress)
    : colors_(std::get_if<ViewStack<std::uint8_t>>(&light_field.samples())) {
  for (int s = 0; s < kNoTrust; ++s) {
    table_[s] = std::exp(-static_cast<float>(s) / (2 * kSigma * kSigma));
  }
  table_[kNoTrust] = 0;
  if (colors_ != nullptr) return;
  rounded_ = rounded_views(light_field, grid, first, progress);
  colors_ = rounded_.get();
}

void RayColors::trusts(const Pair& pair, ColumnRange columns, const std::int32_t* targets,
                       float* trusts) const {
  if (colors_ != nullptr && colors_->channels() == 3) {
    static const RayKernel& kernel = EPISCOPE_CHOOSE_KERNEL(best_isa(), kRayKernel);
    RayTrusts rays;
    rays.begin = columns.begin;
    rays.end = columns.end;
    rays.width = colors_->width();
    rays.row = pair.row;
    rays.other = pair.other;
    rays.last = colors_->height() * colors_->width() - 1;
    rays.targets = targets;
    rays.table = table_.data();
    rays.most = kNoTrust;
    return kernel.find_trusts(rays, trusts);
  }
  for (int x = columns.begin; x < columns.end; ++x) {
    trusts[x] = targets[x] < 0 ? 0.0F : trust(pair, x, targets[x]);
  }
}

float RayColors::trust(const Pair& pair, int x, std::int32_t target) const {
  if (pair.row == nullptr) return 1;
  const std::ptrdiff_t channels = colors_->channels();
  int sum = 0;
  for (std::ptrdiff_t c = 0; c < channels; ++c) {
    const int difference = pair.row[x * channels + c] - pair.other[target * channels + c];
    sum += difference * difference;
  }
  if (channels == 1) sum *= 3;
  return table_[std::min(sum, kNoTrust)];
}

}  // namespace episcope
