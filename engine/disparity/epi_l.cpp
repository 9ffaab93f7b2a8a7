// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_l.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/disparity/disparity_range.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

Schema<EpiLParameters> scales_schema() {
  using P = EpiLParameters;
  return Schema<P>()
      .real("inner_scale", &P::inner_scale,
            {"Inner scale",
             "Standard deviation of the Gaussian applied to the samples before derivatives", "px"},
            {0, 2})
      .real("outer_scale", &P::outer_scale,
            {"Outer scale",
             "Standard deviation of the Gaussian window over which orientation is averaged, along "
             "the EPI",
             "px"},
            {0, 2})
      .real("view_scale", &P::view_scale,
            {"View scale", "Standard deviation of the same window along the views", "views"},
            {0, 3})
      .real("cross_scale", &P::cross_scale,
            {"Cross scale", "Standard deviation of the same window across neighboring EPIs", "px"},
            {0, 2});
}

// Scales and shears that the structure tensor takes from the parameters.
TensorScales scales_of(const EpiLParameters& p) {
  return {p.inner_scale, p.outer_scale, p.view_scale, p.cross_scale, p.contrast, p.noise};
}

// Whole views, or a band of their rows.
struct Maps {
  const LightField& light_field;
  ViewStack<float>& disparity;
  ViewStack<float>& confidence;
  int first_row = 0;
  [[nodiscard]] GridShape grid() const { return disparity.grid(); }
  [[nodiscard]] ViewIndex first() const { return disparity.first(); }
  [[nodiscard]] int rows() const { return disparity.height(); }
  [[nodiscard]] float* disparity_at(ViewIndex view, PixelIndex at) const {
    return disparity.view(view).row(at.y - first_row) + at.x;
  }
  [[nodiscard]] float* confidence_at(ViewIndex view, PixelIndex at) const {
    return confidence.view(view).row(at.y - first_row) + at.x;
  }
};

// Rows of a task of horizontal EPIs: many against the neighbors it shares with the next task, few
// enough to report progress and to end soon after a stop request (about 20 ms at 768 columns).
int band_rows(int height) {
  return std::clamp(height / 8, 8, 96);
}

StructureTensor::Sink store_into(const Maps& maps, int v) {
  return [&maps, v](int u, PixelIndex begin, int count, const float* disparity,
                    const float* coherence) {
    std::copy_n(disparity, count, maps.disparity_at({v, u}, begin));
    std::copy_n(coherence, count, maps.confidence_at({v, u}, begin));
  };
}

// The hardware does not prefetch across steps of a whole image row.
void prefetch_run(const ViewStack<float>& stack, ViewIndex view, PixelIndex begin, int count) {
  constexpr int kRowsAhead = 4;
  constexpr int kCacheLine = 64 / sizeof(float);
  const int row = std::min(begin.y + kRowsAhead, stack.height() - 1);
  const float* first = stack.view(view).row(row) + begin.x;
  for (int i = 0; i < count; i += kCacheLine) __builtin_prefetch(first + i, 1);
}

// The more coherent of two directions.
void take_winner(const float* disparity, const float* coherence, int count, float* to_disparity,
                 float* to_coherence) {
  for (int i = 0; i < count; ++i) {
    const bool wins = coherence[i] > to_coherence[i];
    to_disparity[i] = wins ? disparity[i] : to_disparity[i];
    to_coherence[i] = wins ? coherence[i] : to_coherence[i];
  }
}

StructureTensor::Sink merge_into(const Maps& maps, const EpiLParameters& parameters, int u) {
  return [&maps, &parameters, u](int v, PixelIndex begin, int count, const float* disparity,
                                 const float* coherence) {
    const PixelIndex in_band{begin.y - maps.first_row, begin.x};
    prefetch_run(maps.disparity, {v, u}, in_band, count);
    prefetch_run(maps.confidence, {v, u}, in_band, count);
    float* const to_disparity = maps.disparity_at({v, u}, begin);
    float* const to_coherence = maps.confidence_at({v, u}, begin);
    if (parameters.fusion == Fusion::Winner) {
      take_winner(disparity, coherence, count, to_disparity, to_coherence);
    } else {
      merge_orientations(disparity, coherence, count, parameters.fusion_power, to_disparity,
                         to_coherence);
    }
  };
}

void run_horizontal(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                    const Progress& progress) {
  const LightField& lf = maps.light_field;
  const int rows = band_rows(maps.rows());
  const int bands = (maps.rows() + rows - 1) / rows;
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().v * bands, progress, [&] {
    return [&, tensor = StructureTensor(lf, StructureTensor::Direction::Horizontal, scales,
                                        search)](int i) mutable {
      const int v = first.v + i / bands;
      const int row = i % bands * rows;
      const TensorTask task{
          v,       {maps.first_row + row, 0}, std::min(rows, maps.rows() - row), lf.width(),
          first.u, first.u + maps.grid().u};
      tensor.estimate(task, store_into(maps, v));
    };
  });
}

StructureTensor::Sink store_column_into(const Maps& maps, int u) {
  return [&maps, u](int v, PixelIndex begin, int count, const float* disparity,
                    const float* coherence) {
    store_into(maps, v)(u, begin, count, disparity, coherence);
  };
}

// What becomes of the estimates of a column u of cameras.
using ColumnSink = std::function<StructureTensor::Sink(int u)>;

void run_vertical(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                  const ColumnSink& sink_of, const Progress& progress) {
  const LightField& lf = maps.light_field;
  const TensorExtent largest =
      StructureTensor::largest_task(lf, StructureTensor::Direction::Vertical, scales);
  const int height = largest.height;
  const int width = largest.width;
  const int across = (lf.width() + width - 1) / width;
  const int blocks = across * ((maps.rows() + height - 1) / height);
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().u * blocks, progress, [&] {
    return [&, tensor = StructureTensor(lf, StructureTensor::Direction::Vertical, scales, search)](
               int i) mutable {
      const int u = first.u + i / blocks;
      const int row = i % blocks / across * height;
      const PixelIndex begin{maps.first_row + row, i % blocks % across * width};
      const TensorTask task{u,
                            begin,
                            std::min(height, maps.rows() - row),
                            std::min(width, lf.width() - begin.x),
                            first.v,
                            first.v + maps.grid().v};
      tensor.estimate(task, sink_of(u));
    };
  });
}

void clear_map(ViewStack<float>& stack) {
  std::fill_n(stack.data(), stack.size(), 0.0F);
}

void check_views(const LightField& lf) {
  if (lf.grid().count() == 1) {
    throw InvalidInput("disparity needs at least 2 views, but this light field has only 1");
  }
}

// Of whole views.
MapGeometry selected_maps(const LightField& lf, ViewSelection views) {
  const bool all = views == ViewSelection::All;
  return {all ? lf.grid() : GridShape{1, 1}, all ? ViewIndex{} : lf.center(), lf.height(),
          lf.width()};
}

ViewStack<float> unknown_map(const MapGeometry& maps) {
  return {maps.grid, maps.height, maps.width, 1, maps.first};
}

// Maps of the right shape, not yet filled.
Estimate unknown_maps(const LightField& lf, ViewSelection views, Interval range) {
  const MapGeometry maps = selected_maps(lf, views);
  Estimate estimate;
  estimate.range = range;
  estimate.field.disparity = unknown_map(maps);
  estimate.confidence = unknown_map(maps);
  return estimate;
}

// The whole of EPI_L on the device, or before it is clamped.
Estimate orientations_on_device(const LightField& lf, const EpiLParameters& parameters,
                                ViewSelection views, bool clamps, const Progress& progress) {
  Estimate estimate = begin_orientations(lf, parameters, views, progress.part(0, 0.05));
  cuda::TensorSettings settings = orientation_settings(lf, parameters, estimate.range);
  settings.clamps = clamps;
  settings.clamp_min = static_cast<float>(estimate.range.min);
  settings.clamp_max = static_cast<float>(estimate.range.max);
  cuda::find_orientations(lf, settings, estimate.field.disparity, estimate.confidence,
                          progress.part(0.05, 1));
  return estimate;
}

// One direction of the center view: the filters along the other are left out.
void find_direction(const LightField& lf, cuda::TensorSettings settings,
                    cuda::ViewFilters cuda::TensorSettings::*other, Estimate& estimate,
                    const Progress& progress) {
  settings.*other = {};
  settings.merges = false;
  if (settings.horizontal.views() + settings.vertical.views() == 0) return;
  cuda::find_orientations(lf, settings, estimate.field.disparity, estimate.confidence, progress);
}

// What the publications call coherence is the square of the tensor's.
void finish_confidence(const Maps& maps, Orientation orientation, const Progress& progress) {
  ViewStack<float>& confidence = maps.confidence;
  clear_invalid(maps.light_field, confidence, maps.first_row);
  if (orientation == Orientation::LeastSquares) return;
  parallel_for(confidence.grid().count(), progress, [&](int i) {
    float* const view = confidence.data() + i * confidence.view_size();
    for (std::size_t n = 0; n < confidence.view_size(); ++n) view[n] *= view[n];
  });
}

// Both directions, merged.
void find_orientations(const Maps& maps, const EpiLParameters& parameters, Interval range,
                       const Progress& progress) {
  const GridShape grid = maps.light_field.grid();
  const TensorScales scales = scales_of(parameters);
  const TensorSearch search = search_of(parameters, range);
  // Where the vertical EPIs begin.
  const double half = grid.v == 1 ? 1 : grid.u == 1 ? 0 : 0.5;
  if (grid.u > 1) {
    progress.step("horizontal EPIs");
    run_horizontal(maps, scales, search, progress.part(0, half));
  } else {
    clear_map(maps.disparity);
    clear_map(maps.confidence);
  }
  if (grid.v > 1) {
    progress.step("vertical EPIs");
    const auto merge = [&](int u) { return merge_into(maps, parameters, u); };
    run_vertical(maps, scales, search, merge, progress.part(half, 1));
  }
  finish_confidence(maps, parameters.orientation, progress.part(1, 1));
}

// What a StructureTensor takes, of the direction that takes more.
double tensor_bytes(const LightField& lf, int reach, int cross_radius) {
  constexpr int kColumns = 64, kMostRows = 128;  // of a block of vertical EPIs
  const double views = std::max(lf.grid().u, lf.grid().v);
  const double lanes =
      std::max(lf.width(), kColumns * (std::min(kMostRows, lf.height()) + 2 * reach)) + 2 * reach;
  const double planes = 5 * lf.channels() + 3 + 4 * (2 * cross_radius + 1);
  return sizeof(float) * views * lanes * planes;
}

// The maps, tensors of every thread, and the samples around a band.
std::function<double(int rows)> orientation_bytes(const LightField& lf, const MapGeometry& maps,
                                                  const EpiLParameters& parameters, Interval range,
                                                  int threads) {
  constexpr double kOfRay = 9;
  const auto direction = lf.grid().v > 1 ? StructureTensor::Direction::Vertical
                                         : StructureTensor::Direction::Horizontal;
  const int cross_radius = gaussian_radius(parameters.cross_scale);
  const int reach =
      StructureTensor::reach(lf, direction, scales_of(parameters), search_of(parameters, range));
  const double tensors = threads * tensor_bytes(lf, reach, cross_radius);
  const double map_row = kOfRay * maps.grid.count() * maps.width;
  const double sample_row = lf.is_on_disk() ? static_cast<double>(lf.byte_size()) / lf.height() : 0;
  const int around = lf.grid().v > 1 ? 2 * reach : 2 * cross_radius;
  const int height = lf.height();
  return [=](int rows) {
    return tensors + map_row * rows + sample_row * std::min(rows + around, height);
  };
}

BlockwiseRun epi_l_in_blocks(const LightField& lf, const EpiLParameters& parameters,
                             ViewSelection views, const Progress& progress) {
  BlockwiseRun run = orientations_in_blocks(lf, parameters, views, progress);
  BlockPass& pass = run.passes.front();
  pass.compute = [orientations = std::move(pass.compute), range = run.provenance.range](
                     const MapBlock& block, const ReadBlock& read, const std::vector<double>& facts,
                     const Progress& part) {
    FinishedBlock made = orientations(block, read, facts, part.part(0, 0.97));
    clamp_to_range(made.maps.field.disparity, range, part.part(0.97, 1));
    return made;
  };
  return run;
}

}  // namespace

Schema<EpiLParameters> orientation_schema() {
  using P = EpiLParameters;
  return scales_schema()
      .real("shear_step", &P::shear_step,
            {"Shear step",
             "Spacing of the shears that bring every line close to upright before its orientation "
             "is measured; rounded to half pixels; 0 = whole pixels, and only if the range exceeds "
             "±1.2 px",
             "px"},
            {0, 1.5})
      .real("contrast", &P::contrast,
            {"Contrast limit",
             "Gradients above this are attenuated, so that silhouettes do not drown the texture "
             "beside them; 255 = off",
             "1/255"},
            {0.1, 255, true})
      .real("noise", &P::noise,
            {"Noise floor", "Texture with less contrast than this loses confidence", "1/255"},
            {0, 50})
      .choice("orientation", &P::orientation,
              {"Orientation", "How the disparity is read off the structure tensor"})
      .choice("fusion", &P::fusion,
              {"Fusion",
               "weighted: horizontal and vertical estimates that agree are averaged; winner: the "
               "more coherent one is taken"})
      .integer("fusion_power", &P::fusion_power,
               {"Fusion power",
                "Horizontal and vertical estimates are averaged with weights coherence^p"},
               {0, 32})
      .interval("range", &P::range, {"Disparity range", kRangeHelp, "px"}, {-20, 20});
}

Names<Orientation> names_of(Orientation) {
  return {{Orientation::LeastSquares, "least_squares", "least squares"},
          {Orientation::Eigenvector, "eigenvector"}};
}

Names<Fusion> names_of(Fusion) {
  return {{Fusion::Weighted, "weighted"}, {Fusion::Winner, "winner"}};
}

Schema<EpiLParameters> epi_l_schema() {
  return orientation_schema()
      .part(&EpiLParameters::profile, profile_schema())
      .begin_with(kProfileKey)
      .search("inner_scale", {0.3, 0.5, 0.8, 1.1})
      .search("outer_scale", {0.5, 1, 1.5, 2})
      .search("shear_step", {0.5, 1, 1.5})
      .preset(kProfileKey, kPaperProfile,
              {{"inner_scale", 0.8},
               {"outer_scale", 0.8},
               {"view_scale", 0.8},
               {"cross_scale", 0.0},
               {"shear_step", 0.0},
               {"contrast", 255.0},
               {"noise", 0.0},
               {"orientation", std::string("eigenvector")},
               {"fusion", std::string("winner")}})
      .preset_search(kProfileKey, kPaperProfile, "inner_scale", {0.4, 0.6, 0.8, 1, 1.2})
      .preset_search(kProfileKey, kPaperProfile, "outer_scale", {0.5, 0.8, 1, 1.3, 1.6, 2})
      .preset_search(kProfileKey, kPaperProfile, "view_scale", {0.8, 1.3});
}

TensorSearch search_of(const EpiLParameters& p, Interval range) {
  const int half_steps = static_cast<int>(std::lround(2 * p.shear_step));
  TensorSearch search =
      half_steps > 0 ? cover_range(range, half_steps) : cover_range_sparsely(range);
  search.eigenvector = p.orientation == Orientation::Eigenvector;
  return search;
}

Estimate estimate_epi_l(const LightField& lf, const EpiLParameters& parameters, ViewSelection views,
                        const Progress& progress, Device device) {
  if (device == Device::Cuda) {
    return orientations_on_device(lf, parameters, views, true, progress);
  }
  Estimate estimate = estimate_orientations(lf, parameters, views, progress.part(0, 0.97));
  clamp_to_range(estimate.field.disparity, estimate.range, progress.part(0.97, 1));
  return estimate;
}

void clamp_to_range(ViewStack<float>& disparity, Interval range, const Progress& progress) {
  const auto low = static_cast<float>(range.min);
  const auto high = static_cast<float>(range.max);
  parallel_for(disparity.grid().count(), progress, [&](int i) {
    float* view = disparity.data() + i * disparity.view_size();
    for (std::size_t n = 0; n < disparity.view_size(); ++n) {
      view[n] = std::clamp(view[n], low, high);
    }
  });
}

Estimate estimate_orientations(const LightField& lf, const EpiLParameters& parameters,
                               ViewSelection views, const Progress& progress, Device device) {
  if (device == Device::Cuda) {
    return orientations_on_device(lf, parameters, views, false, progress);
  }
  Estimate estimate = begin_orientations(lf, parameters, views, progress.part(0, 0.05));
  find_orientations({lf, estimate.field.disparity, estimate.confidence}, parameters, estimate.range,
                    progress.part(0.05, 1));
  return estimate;
}

BlockwiseRun orientations_in_blocks(const LightField& lf, const EpiLParameters& parameters,
                                    ViewSelection views, const Progress& progress) {
  check_views(lf);
  BlockwiseRun run;
  const Interval range = search_range(lf, parameters.range, progress);
  run.maps = selected_maps(lf, views);
  run.provenance.range = range;
  BlockPass pass;
  pass.step = "orientations";
  pass.bytes = orientation_bytes(lf, run.maps, parameters, range, progress.threads());
  pass.compute = [&lf, parameters, range](const MapBlock& block, const ReadBlock&,
                                          const std::vector<double>&, const Progress& part) {
    const MapGeometry band{block.views.grid, block.views.first, block.rows(), lf.width()};
    FinishedBlock made{{{unknown_map(band), {}}, unknown_map(band)}};
    lf.fetch_samples(block.first_row, block.end_row);
    find_orientations({lf, made.maps.field.disparity, made.maps.confidence, block.first_row},
                      parameters, range, part);
    return made;
  };
  run.passes.push_back(std::move(pass));
  return run;
}

Estimate begin_orientations(const LightField& lf, const EpiLParameters& parameters,
                            ViewSelection views, const Progress& progress) {
  check_views(lf);
  return unknown_maps(lf, views, search_range(lf, parameters.range, progress));
}

cuda::TensorSettings orientation_settings(const LightField& lf, const EpiLParameters& p,
                                          Interval range) {
  cuda::TensorSettings settings = device_tensor_settings(lf, scales_of(p), search_of(p, range));
  settings.takes_winner = p.fusion == Fusion::Winner;
  settings.fusion_power = p.fusion_power;
  settings.squares_coherence = p.orientation == Orientation::Eigenvector;
  return settings;
}

DirectionalOrientations estimate_directions(const LightField& lf, const EpiLParameters& parameters,
                                            const Progress& progress, Device device) {
  check_views(lf);
  const Interval range = search_range(lf, parameters.range, progress.part(0, 0.1));
  DirectionalOrientations directions{unknown_maps(lf, ViewSelection::Center, range),
                                     unknown_maps(lf, ViewSelection::Center, range)};
  const TensorScales scales = scales_of(parameters);
  const TensorSearch search = search_of(parameters, range);
  const auto maps_of = [&lf](Estimate& estimate) {
    clear_map(estimate.field.disparity);
    clear_map(estimate.confidence);
    return Maps{lf, estimate.field.disparity, estimate.confidence};
  };
  const Maps horizontal = maps_of(directions.horizontal), vertical = maps_of(directions.vertical);
  if (device == Device::Cuda) {
    const cuda::TensorSettings settings = orientation_settings(lf, parameters, range);
    find_direction(lf, settings, &cuda::TensorSettings::vertical, directions.horizontal,
                   progress.part(0.1, 0.55));
    find_direction(lf, settings, &cuda::TensorSettings::horizontal, directions.vertical,
                   progress.part(0.55, 1));
    return directions;
  }
  if (lf.grid().u > 1) {
    progress.step("horizontal EPIs");
    run_horizontal(horizontal, scales, search, progress.part(0.1, 0.55));
  }
  if (lf.grid().v > 1) {
    progress.step("vertical EPIs");
    const auto store = [&](int u) { return store_column_into(vertical, u); };
    run_vertical(vertical, scales, search, store, progress.part(0.55, 1));
  }
  for (const Maps& maps : {horizontal, vertical}) {
    finish_confidence(maps, parameters.orientation, progress.part(1, 1));
  }
  return directions;
}

Estimator epi_l_estimator() {
  return make_estimator<EpiLParameters>(
      {.id = "epi_l",
       .name = "EPI_L",
       .summary = "Local orientation of lines on epipolar plane images (structure tensor)",
       .reference = "Wanner and Goldluecke 2012 [WG12]",
       .all_views = true,
       .revision = 4,
       .devices = {Device::Cpu, Device::Cuda},
       .main_parameters = {"range", "inner_scale", "outer_scale"}},
      epi_l_schema(), estimate_epi_l, epi_l_in_blocks);
}

}  // namespace episcope
