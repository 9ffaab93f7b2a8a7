// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/denoise.h"

#include "engine/core/finding.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/view_samples.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace episcope {
namespace {

// What an invalid pixel holds is no edge, nor where it begins.
void ignore_invalid(ImageView<const std::uint8_t> valid, Image<float>& weights) {
  for (int y = 0; y < valid.height; ++y) {
    const std::uint8_t* const here = valid.row(y);
    const std::uint8_t* const below = valid.row(std::min(y + 1, valid.height - 1));
    for (int x = 0; x < valid.width; ++x) {
      const int right = std::min(x + 1, valid.width - 1);
      if (here[x] == 0 || here[right] == 0 || below[x] == 0) weights.at(y, x) = 1;
    }
  }
}

// r^power. Integer powers are multiplied out, which is vectorized; std::pow is slow.
void raise_row(const float* r, double power, int width, float* raised) {
  const int whole = static_cast<int>(power);
  if (whole != power) {
    const auto exponent = static_cast<float>(power);
    std::transform(r, r + width, raised, [=](float value) { return std::pow(value, exponent); });
    return;
  }
  std::fill_n(raised, width, 1.0F);
  for (int i = 0; i < whole; ++i) {
    for (int x = 0; x < width; ++x) raised[x] *= r[x];
  }
}

// More weight where the map is trusted and its noise is less than `noise`. A map is small: one
// thread will do.
void raise_steady(ImageView<const float> map, float noise, Image<float>& weights) {
  const Image<float> variance = local_noise_variance(map, Progress(1));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const float own = std::sqrt(variance.data()[i]);
    const float more = std::max(noise / std::max(own, noise / kMostSteadyGain), 1.0F) - 1;
    weights.data()[i] *= 1 + more * std::min(weights.data()[i] / kTrustedWeight, 1.0F);
  }
}

double denoise_on_device(const LightField& lf, const DenoiseParameters& parameters,
                         float min_weight, float map_noise, Estimate& estimate,
                         const Progress& progress) {
  const std::vector<double> gaps =
      cuda::denoise_maps(lf, map_denoising(parameters, min_weight, map_noise), estimate.confidence,
                         estimate.field.disparity, progress);
  return *std::max_element(gaps.begin(), gaps.end());
}

constexpr const char* kIslandsKey = "islands";
constexpr float kAgreement_px = 0.5F;
constexpr std::size_t kLeastAround = 3;  // Pixels that a median is taken of.

struct Offset {
  int y = 0, x = 0;
};

bool agree(float a, float b) {
  return std::abs(a - b) <= kAgreement_px;
}

// A map with a margin that agrees with nothing, so that every pixel has all its neighbors.
class Surroundings {
 public:
  static constexpr int kMargin = 2;

  Surroundings(ImageView<const float> map, const Progress& progress)
      : padded_(map.height + 2 * kMargin, 1, map.width + 2 * kMargin) {
    parallel_for(padded_.height(), progress, [&](int i) { fill(map, i - kMargin); });
  }
  // Readable for the margin on either side, and above and below.
  [[nodiscard]] float* row(int y) { return padded_.view().row(y + kMargin, 0) + kMargin; }
  [[nodiscard]] const float* row(int y) const {
    return padded_.view().row(y + kMargin, 0) + kMargin;
  }
  void forget(Offset at) { row(at.y)[at.x] = kNothing; }

  // Calls `visit(y, x, value)` for the pixels within `radius` of a pixel, itself left out.
  template <class Visit>
  void for_around(Offset at, int radius, Visit&& visit) const {
    for (int y = at.y - radius; y <= at.y + radius; ++y) {
      for (int x = at.x - radius; x <= at.x + radius; ++x) {
        if (y != at.y || x != at.x) visit(y, x, row(y)[x]);
      }
    }
  }

 private:
  static constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

  void fill(ImageView<const float> map, int y) {
    float* const first = row(y) - kMargin;
    if (y < 0 || y >= map.height) {
      std::fill_n(first, padded_.width(), kNothing);
      return;
    }
    std::fill_n(first, kMargin, kNothing);
    std::copy_n(map.row(y), map.width, row(y));
    std::fill_n(row(y) + map.width, kMargin, kNothing);
  }

  Volume<float> padded_;
};

// How many of its neighbors agree with a pixel.
int agreeing(const Surroundings& map, int y, int x) {
  const float* const above = map.row(y - 1) + x;
  const float* const here = map.row(y) + x;
  const float* const below = map.row(y + 1) + x;
  const float own = *here;
  return int{agree(above[-1], own)} + int{agree(above[0], own)} + int{agree(above[1], own)} +
         int{agree(here[-1], own)} + int{agree(here[1], own)} + int{agree(below[-1], own)} +
         int{agree(below[0], own)} + int{agree(below[1], own)};
}

// Of a pixel with which one neighbor agrees, or none.
bool is_island(const Surroundings& map, Offset at) {
  const float own = map.row(at.y)[at.x];
  if (!std::isfinite(own)) return false;
  bool is_alone = true;
  int nearer = 0, farther = 0;
  map.for_around(at, 1, [&](int y, int x, float other) {
    if (agree(other, own)) {
      is_alone = is_alone && agreeing(map, y, x) == 1;
    } else {
      nearer += other > own ? 1 : 0;
      farther += other < own ? 1 : 0;
    }
  });
  return is_alone && (nearer == 0 || farther == 0);
}

// Of each row.
std::vector<std::vector<Offset>> find_islands(const Surroundings& map, int height, int width,
                                              const Progress& progress) {
  std::vector<std::vector<Offset>> islands(static_cast<std::size_t>(height));
  parallel_for_workers(height, progress, [&] {
    return [&, counts = std::vector<int>(static_cast<std::size_t>(width))](int y) mutable {
      for (int x = 0; x < width; ++x) counts[x] = agreeing(map, y, x);
      for (int x = 0; x < width; ++x) {
        if (counts[x] <= 1 && is_island(map, {y, x})) islands[y].push_back({y, x});
      }
    };
  });
  return islands;
}

// The median of what is known around a pixel; `own` where that is too little.
float median_around(const Surroundings& known, Offset at, float own) {
  std::vector<float> values;
  for (int radius = 1; radius <= Surroundings::kMargin && values.size() < kLeastAround; ++radius) {
    values.clear();
    known.for_around(at, radius, [&](int, int, float value) {
      if (std::isfinite(value)) values.push_back(value);
    });
  }
  if (values.size() < kLeastAround) return own;
  return quantile(values, 0.5);
}

}  // namespace

Image<float> smoothness_weights(const LightField& lf, ViewIndex view, double beta,
                                double noise_variance) {
  Image<float> weights(lf.height(), lf.width(), 1, 1.0F);
  if (beta == 0) return weights;
  gradient_magnitude(lf, view, weights.view());
  const auto strength = static_cast<float>(-beta * std::sqrt(channel_weight(lf.channels())));
  const auto of_noise = static_cast<float>(4 * lf.channels() * noise_variance);
  for (float& weight : weights) {
    weight = std::exp(strength * std::sqrt(std::max(0.0F, weight * weight - of_noise)));
  }
  if (!lf.valid().empty()) ignore_invalid(lf.valid_of(view), weights);
  return weights;
}

Schema<StopParameters> stop_schema() {
  return Schema<StopParameters>()
      .integer("max_iterations", &StopParameters::max_iterations,
               {"Iterations", "Maximum denoising iterations, at full resolution"}, {1, 2000, true})
      .real("gap", &StopParameters::gap,
            {"Stop at gap",
             "Denoising stops once the duality gap falls below this fraction of the energy"},
            {1e-6, 0.1, true});
}

Schema<DenoiseParameters> denoise_schema() {
  using P = DenoiseParameters;
  return Schema<P>()
      .real("lambda", &P::lambda,
            {"Smoothing λ", "Weight of the total variation; larger values are smoother"},
            {0.001, 10, true})
      .real("weight_power", &P::weight_power,
            {"Confidence exponent p",
             "The data term is weighted by confidence^p; 0 weights all pixels equally, as in the "
             "paper"},
            {0, 16})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "The total variation is weighted by exp(−β·|gradient of the view|); 0 ignores image "
             "edges, as in the paper"},
            {0, 100})
      .part(&P::stop, stop_schema());
}

ParameterSet plain_denoising() {
  return {{"weight_power", 0.0}, {"edge_strength", 0.0}};
}

void fill_data_weights(ImageView<const float> confidence, DataWeight weight,
                       Image<float>& weights) {
  for (int y = 0; y < confidence.height; ++y) {
    float* w = weights.row(y);
    raise_row(confidence.row(y), weight.power, confidence.width, w);
    for (int x = 0; x < confidence.width; ++x) w[x] = std::max(w[x], weight.minimum);
  }
}

cuda::MapDenoising map_denoising(const DenoiseParameters& p, float min_weight, float map_noise) {
  return {p.lambda,  p.weight_power,        min_weight, p.edge_strength,
          map_noise, p.stop.max_iterations, p.stop.gap};
}

std::string gap_note(double largest) {
  return fmt::format(finding_text("gap"), largest);
}

double denoise(const LightField& lf, const DenoiseParameters& parameters,
               const DenoiseWeights& weighing, ViewStack<float>& disparity,
               const ViewStack<float>& confidence, const Progress& progress) {
  const GridShape grid = disparity.grid();
  const ViewIndex first = disparity.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, solver = TvL2Solver(lf.height(), lf.width()),
            weights = Image<float>(lf.height(), lf.width())](int i) mutable {
      const ViewIndex view = grid.view_at(i, first);
      fill_data_weights(confidence.view(view), {parameters.weight_power, weighing.min_weight},
                        weights);
      if (weighing.map_noise > 0) raise_steady(disparity.view(view), weighing.map_noise, weights);
      const Image<float> edges = smoothness_weights(lf, view, parameters.edge_strength);
      const ImageView<float> map = disparity.view(view);
      gaps[i] = solver
                    .solve({map, weights, edges, parameters.lambda},
                           {parameters.stop.max_iterations, parameters.stop.gap}, progress, map)
                    .relative_gap();
    };
  });
  return *std::max_element(gaps.begin(), gaps.end());
}

void denoise(const LightField& lf, const DenoiseParameters& parameters, Estimate& estimate,
             const Progress& progress, float min_weight, float map_noise, Device device) {
  progress.step("denoising");
  const double gap =
      device == Device::Cuda
          ? denoise_on_device(lf, parameters, min_weight, map_noise, estimate, progress)
          : denoise(lf, parameters, {min_weight, map_noise}, estimate.field.disparity,
                    estimate.confidence, progress);
  estimate.notes.push_back(gap_note(gap));
}

Schema<IslandParameters> island_schema() {
  return Schema<IslandParameters>().flag(
      kIslandsKey, &IslandParameters::islands,
      {"Remove specks",
       "One or two pixels nearer than all their neighbors, or farther, take the median of these; "
       "off, as in the paper"});
}

ParameterSet plain_islands() {
  return {{kIslandsKey, false}};
}

void fill_islands(const Progress& progress, ImageView<float> disparity) {
  Surroundings map(disparity, progress);
  const auto islands = find_islands(map, disparity.height, disparity.width, progress);
  for (const std::vector<Offset>& row : islands) {
    for (const Offset& island : row) map.forget(island);
  }
  for (const std::vector<Offset>& row : islands) {
    for (const Offset& island : row) {
      float& value = disparity.at(island.y, island.x);
      value = median_around(map, island, value);
    }
  }
}

void fill_islands(const IslandParameters& parameters, const Progress& progress,
                  ImageView<float> disparity) {
  if (parameters.islands) fill_islands(progress, disparity);
}

}  // namespace episcope
