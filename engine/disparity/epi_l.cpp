// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_l.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/structure_tensor.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

struct Maps {
  const LightField& light_field;
  ViewStack<float>& disparity;
  ViewStack<float>& confidence;
  [[nodiscard]] GridShape grid() const { return disparity.grid(); }
  [[nodiscard]] ViewIndex first() const { return disparity.first(); }
};

// Rows of a task of horizontal EPIs: many against the neighbours it shares with the next task, few
// enough to report progress and to end soon after a stop request (about 20 ms at 768 columns).
int band_rows(int height) {
  return std::clamp(height / 8, 8, 96);
}

StructureTensor::Sink store_into(const Maps& maps, int v) {
  return [&maps, v](int u, PixelIndex begin, int count, const float* disparity,
                    const float* coherence) {
    std::copy_n(disparity, count, maps.disparity.view({v, u}).row(begin.y) + begin.x);
    std::copy_n(coherence, count, maps.confidence.view({v, u}).row(begin.y) + begin.x);
  };
}

StructureTensor::Sink merge_into(const Maps& maps, int power, int u) {
  return [&maps, power, u](int v, PixelIndex begin, int count, const float* disparity,
                           const float* coherence) {
    merge_orientations(disparity, coherence, count, power,
                       maps.disparity.view({v, u}).row(begin.y) + begin.x,
                       maps.confidence.view({v, u}).row(begin.y) + begin.x);
  };
}

void run_horizontal(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                    const Progress& progress) {
  const LightField& lf = maps.light_field;
  const int rows = band_rows(lf.height());
  const int bands = (lf.height() + rows - 1) / rows;
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().v * bands, progress, [&]() -> std::function<void(int)> {
    auto tensor = std::make_shared<StructureTensor>(lf, StructureTensor::Direction::Horizontal,
                                                    scales, search);
    return [&, tensor](int i) {
      const int v = first.v + i / bands;
      const int y = i % bands * rows;
      const TensorTask task{v,          {y, 0},  std::min(rows, lf.height() - y),
                            lf.width(), first.u, first.u + maps.grid().u};
      tensor->estimate(task, store_into(maps, v));
    };
  });
}

void run_vertical(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                  int power, const Progress& progress) {
  const LightField& lf = maps.light_field;
  const StructureTensor sizes(lf, StructureTensor::Direction::Vertical, scales, search);
  const int width = sizes.max_width();
  const int height = sizes.max_height();
  const int blocks = (lf.width() + width - 1) / width;
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().u * blocks, progress, [&]() -> std::function<void(int)> {
    auto tensor =
        std::make_shared<StructureTensor>(lf, StructureTensor::Direction::Vertical, scales, search);
    return [&, tensor](int i) {
      const int u = first.u + i / blocks;
      const int x = i % blocks * width;
      for (int y = 0; y < lf.height(); y += height) {
        const TensorTask task{u,
                              {y, x},
                              std::min(height, lf.height() - y),
                              std::min(width, lf.width() - x),
                              first.v,
                              first.v + maps.grid().v};
        tensor->estimate(task, merge_into(maps, power, u));
      }
    };
  });
}

void clear(ViewStack<float>& stack) {
  std::fill_n(stack.data(), stack.size(), 0.0F);
}

}  // namespace

Schema<EpiLParameters> epi_l_schema() {
  Schema<EpiLParameters> schema;
  add_epi_l_parameters(schema);
  schema.search("inner_scale", {0.3, 0.5, 0.8, 1.1})
      .search("outer_scale", {0.5, 1, 1.5, 2})
      .search("shear_step", {0.5, 1, 1.5});
  return schema;
}

Estimate estimate_epi_l(const LightField& lf, const EpiLParameters& parameters, ViewSelection views,
                        const Progress& progress) {
  Estimate estimate = estimate_orientations(lf, parameters, views, progress.part(0, 0.97));
  clamp_to_range(estimate, progress.part(0.97, 1));
  return estimate;
}

void clamp_to_range(Estimate& estimate, const Progress& progress) {
  const auto low = static_cast<float>(estimate.range.min);
  const auto high = static_cast<float>(estimate.range.max);
  ViewStack<float>& disparity = estimate.field.disparity;
  parallel_for(disparity.grid().count(), progress, [&](int i) {
    float* view = disparity.data() + i * disparity.view_size();
    for (std::size_t n = 0; n < disparity.view_size(); ++n) {
      view[n] = std::clamp(view[n], low, high);
    }
  });
}

Estimate estimate_orientations(const LightField& lf, const EpiLParameters& parameters,
                               ViewSelection views, const Progress& progress) {
  if (lf.grid().count() == 1) {
    throw InvalidInput("disparity needs at least 2 views, but this light field has only 1");
  }
  Estimate estimate;
  estimate.range = search_range(lf, parameters.range, progress.part(0, 0.05));
  const bool all = views == ViewSelection::All;
  const GridShape grid = all ? lf.grid() : GridShape{1, 1};
  const ViewIndex first = all ? ViewIndex{} : lf.center();
  estimate.field.disparity = ViewStack<float>(grid, lf.height(), lf.width(), 1, first);
  estimate.confidence = ViewStack<float>(grid, lf.height(), lf.width(), 1, first);
  const Maps maps{lf, estimate.field.disparity, estimate.confidence};
  const TensorScales scales{parameters.inner_scale, parameters.outer_scale, parameters.view_scale,
                            parameters.cross_scale, parameters.contrast,    parameters.noise};
  const TensorSearch search = cover_range(
      estimate.range, std::max(1, static_cast<int>(std::lround(2 * parameters.shear_step))));
  // Where the vertical EPIs begin.
  const double half = lf.grid().v == 1 ? 1 : lf.grid().u == 1 ? 0.05 : 0.5;
  if (lf.grid().u > 1) {
    progress.step("horizontal EPIs");
    run_horizontal(maps, scales, search, progress.part(0.05, half));
  } else {
    clear(estimate.field.disparity);
    clear(estimate.confidence);
  }
  if (lf.grid().v > 1) {
    progress.step("vertical EPIs");
    run_vertical(maps, scales, search, parameters.fusion_power, progress.part(half, 1));
  }
  return estimate;
}

Estimator epi_l_estimator() {
  return make_estimator<EpiLParameters>(
      {"epi_l", "EPI_L", "Orientation of lines on epipolar plane images (structure tensor), local",
       "Wanner and Goldluecke 2012 [WG12]", true},
      epi_l_schema(), estimate_epi_l);
}

}  // namespace episcope
