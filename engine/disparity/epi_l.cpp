// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_l.h"

#include "engine/core/parallel.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/structure_tensor.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

// Rows of a vertical band: its planes stay in the L2 cache.
constexpr int kBandRows = 128;
// Directions that agree within this many px are averaged.
constexpr float kAgreement = 0.3F;

struct Maps {
  const LightField& light_field;
  ViewStack<float>& disparity;
  ViewStack<float>& confidence;
  [[nodiscard]] GridShape grid() const { return disparity.grid(); }
  [[nodiscard]] ViewIndex first() const { return disparity.first(); }
};

struct Fusion {
  float power;

  // eq. r^p: raises to a power of two by squaring where it can.
  [[nodiscard]] float weight(float coherence) const {
    if (power == 8) {
      const float second = coherence * coherence;
      const float fourth = second * second;
      return fourth * fourth;
    }
    return std::pow(coherence, power);
  }

  void merge(const float* disparity, const float* coherence, int count, float* to_disparity,
             float* to_coherence) const {
    for (int i = 0; i < count; ++i) {
      const float here = coherence[i];
      const float there = to_coherence[i];
      const float difference = disparity[i] - to_disparity[i];
      if (here > 0 && there > 0 && std::fabs(difference) < kAgreement) {
        const float share = weight(here) / (weight(here) + weight(there) + 1e-30F);
        to_disparity[i] += share * difference;
      } else if (here > there) {
        to_disparity[i] = disparity[i];
      }
      to_coherence[i] = std::max(here, there);
    }
  }
};

void run_horizontal(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                    const Progress& progress) {
  const int height = maps.light_field.height();
  const int width = maps.light_field.width();
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().v * height, progress, [&]() -> std::function<void(int)> {
    auto tensor = std::make_shared<StructureTensor>(
        maps.light_field, StructureTensor::Direction::Horizontal, scales, search);
    return [&, tensor](int i) {
      const int v = first.v + i / height;
      const int y = i % height;
      tensor->estimate({v, y, first.u, first.u + maps.grid().u}, 0, width);
      for (int u = first.u; u < first.u + maps.grid().u; ++u) {
        std::copy_n(tensor->disparity(u), width, maps.disparity.view({v, u}).row(y));
        std::copy_n(tensor->coherence(u), width, maps.confidence.view({v, u}).row(y));
      }
    };
  });
}

void merge_vertical(const Maps& maps, const StructureTensor& tensor, const Fusion& fusion,
                    ViewIndex view, PixelIndex begin, int rows) {
  constexpr int kColumns = StructureTensor::kColumns;
  const int columns = std::min(kColumns, maps.light_field.width() - begin.x);
  for (int i = 0; i < rows; ++i) {
    fusion.merge(tensor.disparity(view.v) + static_cast<std::ptrdiff_t>(i) * kColumns,
                 tensor.coherence(view.v) + static_cast<std::ptrdiff_t>(i) * kColumns, columns,
                 maps.disparity.view(view).row(begin.y + i) + begin.x,
                 maps.confidence.view(view).row(begin.y + i) + begin.x);
  }
}

void run_vertical(const Maps& maps, const TensorScales& scales, const TensorSearch& search,
                  const Fusion& fusion, const Progress& progress) {
  constexpr int kColumns = StructureTensor::kColumns;
  const int height = maps.light_field.height();
  const int blocks = (maps.light_field.width() + kColumns - 1) / kColumns;
  const ViewIndex first = maps.first();
  parallel_for_workers(maps.grid().u * blocks, progress, [&]() -> std::function<void(int)> {
    auto tensor = std::make_shared<StructureTensor>(
        maps.light_field, StructureTensor::Direction::Vertical, scales, search);
    return [&, tensor](int i) {
      const int u = first.u + i / blocks;
      const int x = i % blocks * kColumns;
      for (int y = 0; y < height; y += kBandRows) {
        const int rows = std::min(kBandRows, height - y);
        tensor->estimate({u, x, first.v, first.v + maps.grid().v}, y, y + rows);
        for (int v = first.v; v < first.v + maps.grid().v; ++v) {
          merge_vertical(maps, *tensor, fusion, {v, u}, {y, x}, rows);
        }
      }
    };
  });
}

void clear(ViewStack<float>& stack) { std::fill_n(stack.data(), stack.size(), 0.0F); }

}  // namespace

Schema<EpiLParameters> epi_l_schema() {
  using P = EpiLParameters;
  Schema<P> schema;
  schema
      .real("inner_scale", &P::inner_scale,
            {"Inner scale", "Gaussian smoothing of the samples before derivatives are taken", "px"},
            {0, 2})
      .real("outer_scale", &P::outer_scale,
            {"Outer scale", "Gaussian window over which orientation is averaged", "px"}, {0, 2})
      .real("shear_step", &P::shear_step,
            {"Shear step",
             "Distance of the shears that bring every disparity near to upright before its "
             "orientation is measured; rounded to half pixels",
             "px"},
            {0.5, 2})
      .real("noise", &P::noise,
            {"Sample noise", "Standard deviation of the noise; weaker texture loses confidence",
             "1/255"},
            {0, 50})
      .real("fusion_power", &P::fusion_power,
            {"Fusion power",
             "Horizontal and vertical estimates are averaged with weights coherence^p"},
            {0, 32})
      .interval("range", &P::range,
                {"Disparity range",
                 "Disparities searched; auto takes what the files promise or finds it from the "
                 "light field",
                 "px"},
                {-20, 20});
  return schema;
}

Estimate estimate_epi_l(const LightField& lf, const EpiLParameters& parameters,
                        ViewSelection views, const Progress& progress) {
  Estimate estimate;
  estimate.range = search_range(lf, parameters.range, progress.part(0, 0.05));
  const bool all = views == ViewSelection::All;
  const GridShape grid = all ? lf.grid() : GridShape{1, 1};
  const ViewIndex first = all ? ViewIndex{} : lf.center();
  estimate.field.disparity = ViewStack<float>(grid, lf.height(), lf.width(), 1, first);
  estimate.confidence = ViewStack<float>(grid, lf.height(), lf.width(), 1, first);
  const Maps maps{lf, estimate.field.disparity, estimate.confidence};
  const TensorScales scales{parameters.inner_scale, parameters.outer_scale, parameters.noise};
  const TensorSearch search = cover_range(
      estimate.range, std::max(1, static_cast<int>(std::lround(2 * parameters.shear_step))));
  if (lf.grid().u > 1) {
    progress.step("horizontal EPIs");
    run_horizontal(maps, scales, search, progress.part(0.05, 0.5));
  } else {
    clear(estimate.field.disparity);
    clear(estimate.confidence);
  }
  if (lf.grid().v > 1) {
    progress.step("vertical EPIs");
    run_vertical(maps, scales, search, {static_cast<float>(parameters.fusion_power)},
                 progress.part(0.5, 1));
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
