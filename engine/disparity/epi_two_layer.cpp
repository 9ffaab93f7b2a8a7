// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi_two_layer.h"

#include "engine/core/finding.h"
#include "engine/core/image.h"
#include "engine/core/numbers.h"
#include "engine/core/parallel.h"
#include "engine/core/progress.h"
#include "engine/cuda/host_pages.h"
#include "engine/cuda/layer_solver.h"
#include "engine/cuda/orientations.h"
#include "engine/disparity/disparity_range.h"
#include "engine/disparity/double_orientation.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/kernels/line_kernel.h"
#include "engine/disparity/kernels/shared_constants.h"
#include "engine/disparity/view_samples.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Sums over windows of one quantity after the other.
class Windows {
 public:
  explicit Windows(int width) : column_(width), mean_(width) {}

  const float* mean(const Image<float>& image, int y) {
    window_mean_row(image, y, kLineFitRadius, column_.data(), mean_.data());
    return mean_.data();
  }

 private:
  std::vector<float> column_, mean_;
};

// Samples of one channel, and the squares of all.
void read_row(const std::uint32_t* packed, int width, int y, std::array<Image<float>, 3>& samples,
              Image<float>& squares) {
  for (int c = 0; c < 3; ++c) {
    float* const to = samples[c].row(y);
    for (int x = 0; x < width; ++x) {
      to[x] = packed_sample(packed[x], c);
      squares.at(y, x) += to[x] * to[x];
    }
  }
}

// How well lines of one disparity explain a view, as a coherence: 1 − s·e/v, with e the mean over
// 5×5 pixels of the residuals of `disparity` (LineResiduals) and v what it would be if pixels had
// nothing to do with their lines, twice the variance of color there. Each of `coherence` that is
// less is raised to it. Beside a silhouette, where every window of a structure tensor holds two
// orientations, lines fit in half of the views at least; behind a transparent surface none fits.
// The strictness s makes up for views that are near, where other lines fit nearly as well.
// All images are `[y][x]` of one size; `residuals` has begun the view. Throws Cancelled.
void raise_by_line_fit(ImageView<const std::uint32_t> view, ImageView<const float> disparity,
                       float strictness, LineResiduals& residuals, Image<float>& coherence) {
  const int height = view.height, width = view.width;
  const Image<float> blank(height, width);
  std::array<Image<float>, 3> samples = {blank, blank, blank};
  Image<float> squares = blank, misfit = blank;
  for (int y = 0; y < height; ++y) {
    read_row(view.row(y), width, y, samples, squares);
    const float* const residual = residuals.row(y, disparity.row(y));
    std::transform(residual, residual + width, misfit.row(y),
                   [](float value) { return std::min(value, kMostFitResidual); });
  }
  Windows windows(width);
  std::vector<float> variance(width);
  for (int y = 0; y < height; ++y) {
    std::copy_n(windows.mean(squares, y), width, variance.data());
    for (const Image<float>& channel : samples) {
      const float* const mean = windows.mean(channel, y);
      for (int x = 0; x < width; ++x) variance[x] -= mean[x] * mean[x];
    }
    const float* const off = windows.mean(misfit, y);
    for (int x = 0; x < width; ++x) {
      const float unrelated = 2 * std::max(variance[x], kLeastFitVariance);
      coherence.at(y, x) = std::max(coherence.at(y, x), 1 - strictness * off[x] / unrelated);
    }
  }
}

// Of a layer, weighted by confidence; and those of it.
struct Moments {
  Image<float> weights, sums, squares;

  Moments(int height, int width)
      : weights(height, width), sums(height, width), squares(height, width) {}

  void fill_row(const float* layer, const std::uint8_t* confidence, int y) {
    for (int x = 0; x < weights.width(); ++x) {
      const float weight = confidence[x], d = layer[x];
      weights.at(y, x) = weight;
      sums.at(y, x) = weight * d;
      squares.at(y, x) = weight * d * d;
    }
  }
};

// Means over windows, row by row; one per thread.
class MeanRows {
 public:
  explicit MeanRows(const Moments& moments)
      : moments_(moments), columns_(moments.weights.width()), means_(3, moments.weights.width()) {}

  // Raises a row of `most` to the variance.
  void raise(int y, float* most) {
    window_mean_row(moments_.weights, y, kLayerVarianceRadius, columns_.data(), means_.row(0));
    window_mean_row(moments_.sums, y, kLayerVarianceRadius, columns_.data(), means_.row(1));
    window_mean_row(moments_.squares, y, kLayerVarianceRadius, columns_.data(), means_.row(2));
    const float *const weight = means_.row(0), *const sum = means_.row(1),
                       *const square = means_.row(2);
    for (int x = 0; x < means_.width(); ++x) {
      const float of = std::max(weight[x], kLeastLayerConfidence), mean = sum[x] / of;
      most[x] = std::max(most[x], square[x] / of - mean * mean);
    }
  }

 private:
  const Moments& moments_;
  std::vector<float> columns_;
  Image<float> means_;
};

// Raises `most` to the variance of a layer.
void add_variance(ImageView<const float> layer, ImageView<const std::uint8_t> confidence,
                  Image<float>& most, const Progress& progress) {
  Moments moments(layer.height, layer.width);
  parallel_for(layer.height, progress,
               [&](int y) { moments.fill_row(layer.row(y), confidence.row(y), y); });
  parallel_for_workers(layer.height, progress, [&] {
    return [&, means = MeanRows(moments)](int y) mutable { means.raise(y, most.row(y)); };
  });
}

// How far two layers are surfaces, in [0, 1]. Two orientations that are read into noise, or into
// silhouettes, leap from pixel to pixel; those of a transparent surface and of what is behind it
// do not. With s² the variance of disparity over the 5×5 px around a pixel, weighted by
// confidence, of the layer that varies more, and s₀ = 0.2 px: the mean of 1/(1 + s²/s₀²) over 9×9
// px, of which 0.3 is no surface and 0.5 is one. All images are `[y][x]` of one size; `confidence`
// in 1/255. Throws Cancelled. Evidence: tests/accuracy/tuning.md.
Image<float> layer_steadiness(ImageView<const float> near, ImageView<const float> far,
                              ImageView<const std::uint8_t> confidence, const Progress& progress) {
  Image<float> variance(near.height, near.width), steadiness(near.height, near.width);
  add_variance(near, confidence, variance, progress.part(0, 0.4));
  add_variance(far, confidence, variance, progress.part(0.4, 0.8));
  for (float& value : variance) value = 1 / (1 + value / (kLayerSpread * kLayerSpread));
  parallel_for_workers(near.height, progress.part(0.8, 1), [&] {
    return [&, columns = std::vector<float>(near.width)](int y) mutable {
      float* const row = steadiness.row(y);
      window_mean_row(variance, y, kSteadyRadius, columns.data(), row);
      for (int x = 0; x < near.width; ++x) {
        row[x] = std::clamp((row[x] - kUnsteadyMean) / (kSteadyMean - kUnsteadyMean), 0.0F, 1.0F);
      }
    };
  });
  return steadiness;
}

// Misfit of one orientation as a fraction of the misfits of one and of two: (1 − r)/(2 − r − c +
// 0.03), in [0, 1), with coherence r of one and confidence c of two. The constant decides for one
// where both fit almost perfectly.
[[nodiscard]] inline float single_misfit_share(float coherence, float confidence) {
  return (1 - coherence) / (2 - coherence - confidence + kLeastMisfit);
}

// The largest coherence within 2 px of each pixel, in x and y: the best of the windows that hold
// the pixel. Beside a silhouette one of them fits one orientation, in front of a transparent
// surface none does. `rows` is scratch; all are `[y][x]` of one size.
void spread_coherence(ImageView<const float> coherence, Image<float>& rows, Image<float>& spread) {
  const int height = coherence.height, width = coherence.width;
  for (int y = 0; y < height; ++y) {
    const float* from = coherence.row(y);
    float* to = rows.row(y);
    for (int x = 0; x < width; ++x) {
      const int begin = std::max(0, x - kCoherenceReach),
                end = std::min(width, x + kCoherenceReach + 1);
      to[x] = *std::max_element(from + begin, from + end);
    }
  }
  for (int y = 0; y < height; ++y) {
    float* to = spread.row(y);
    std::copy_n(rows.row(y), width, to);
    for (int j = std::max(0, y - kCoherenceReach); j < std::min(height, y + kCoherenceReach + 1);
         ++j) {
      const float* from = rows.row(j);
      for (int x = 0; x < width; ++x) to[x] = std::max(to[x], from[x]);
    }
  }
}

// Tiles looked at: one of so many.
constexpr int kTileStride = 3;
// Thresholds for an unambiguous pixel, and the fraction of such pixels that is not accidental.
constexpr float kSureShare = 0.35F;
constexpr float kSureConfidence = 0.6F;
constexpr double kEnoughLayers = 0.03;
// Share of those pixels that may lie beyond either end, and what is added to both ends.
constexpr double kLayerTail = 0.01;
constexpr double kMargin = 0.1;

// Farther apart than orientations that are not there come out.
constexpr double kMinDistance = 0.3;

// What EPI_TWO_LAYER on the CPU and on the device have in common.

// Variation of the surface across the border of its region, and of either layer at least.
constexpr float kLayerBorderWeight = 0.02F;
// Of data, as in EPI_S.
constexpr float kLeastLayerWeight = 0.003F;
// The region must be right to a pixel, not to a thousandth.
constexpr int kRegionIterations = 10;
constexpr double kRegionGap = 1e-3;

// What EPI_TWO_LAYER looks for in a light field.
struct LayerSearch {
  EpiLParameters single;  // Of orientations, whose range is settled.
  EpiLParameters fit;     // Of their coherence beside that of double ones.
  TensorScales double_scales;
  DoubleSearch doubles;
};

// Of two orientations, which are harder to tell from noise than one.
constexpr double kCrossScaleOfLayers = 1;
// Cut off at the range itself, noise about its ends would no longer average out.
constexpr double kLayerOvershoot = 0.3;

// Throws as `search_layer_range`.
LayerSearch begin_layer_search(const LightField& lf, const EpiTwoLayerParameters& parameters,
                               const Progress& progress, Device device) {
  LayerSearch search;
  search.single = parameters.tensor;
  search.double_scales = {parameters.double_inner_scale, parameters.double_outer_scale,
                          search.single.view_scale,      kCrossScaleOfLayers,
                          parameters.double_contrast,    search.single.noise};
  const Interval range =
      search_layer_range(lf, search.single, search.double_scales, progress, device);
  search.single.range = range;
  search.fit = search.single;
  search.fit.cross_scale = kCrossScaleOfLayers;
  search.doubles = {{range.min - kLayerOvershoot, range.max + kLayerOvershoot},
                    parameters.least_distance};
  return search;
}

// Whole maps of some views, raw, which the results replace: the single orientation and its
// coherence after lines were checked, the foreground and background of double orientations, and
// their confidence in 1/255 in place of the number of layers.
struct LayeredMaps {
  const ViewStack<float>& fit;  // Coherence of single orientations before lines were checked.
  ViewStack<float>& single;
  ViewStack<float>& coherence;
  LayeredDisparity& layered;
};

// What one thread needs to solve a view.
struct Workspace {
  TvL2Solver solver;
  Image<float> data, weight, edge, coherence;

  Workspace(int height, int width)
      : solver(height, width),
        data(height, width),
        weight(height, width),
        edge(height, width),
        coherence(height, width) {}
};

// One view: raw maps, replaced by the results.
struct LayeredView {
  ImageView<const float> fit;  // coherence before lines were checked
  ImageView<float> single, coherence;
  ImageView<float> near, far;
  ImageView<std::uint8_t> layers;  // raw: confidence in 1/255
};

class ViewSmoother {
 public:
  ViewSmoother(const LightField& lf, const PackedViews& packed,
               const EpiTwoLayerParameters& parameters, const Progress& progress)
      : lf_(lf),
        parameters_(parameters),
        progress_(progress),
        score_(packed, lf.grid(), parameters.decision),
        space_(lf.height(), lf.width()) {}

  // Returns the largest relative gap of its solutions.
  double solve(ViewIndex index, const LayeredView& view) {
    if (region_.empty()) region_ = Image<std::uint8_t>(lf_.height(), lf_.width());
    find_region(index, view);
    find_weights(view);
    const Image<float> edges = smoothness_weights(lf_, index, parameters_.edge_strength);
    double gap = 0;
    // The background last: outside the region it is what both layers hold.
    if (std::any_of(region_.begin(), region_.end(), [](std::uint8_t m) { return m != 0; })) {
      gap = solve_foreground(edges, view);
    }
    gap = std::max(gap, solve_background(edges, view));
    finish(view);
    return gap;
  }

 private:
  void find_region(ViewIndex index, const LayeredView& view) {
    score_.judge(index, {view.fit, view.single, view.near, view.far, view.layers},
                 space_.data.view(), space_.weight.view());
    segment_binary(space_.solver, {space_.data, space_.weight, {}, parameters_.region_smoothness},
                   {kRegionIterations, kRegionGap}, progress_, space_.edge.view(), region_.view());
  }

  // Of either layer's data.
  void find_weights(const LayeredView& view) {
    Image<float>& trust = space_.coherence;
    for (std::size_t i = 0; i < region_.size(); ++i) {
      trust.data()[i] = region_.data()[i] != 0 ? confidence(view, i) : view.coherence.data[i];
    }
    fill_data_weights(trust, {parameters_.weight_power, kLeastLayerWeight}, space_.weight);
  }

  double solve_background(const Image<float>& edges, const LayeredView& view) {
    for (std::size_t i = 0; i < region_.size(); ++i) {
      const bool is_double = region_.data()[i] != 0;
      space_.data.data()[i] = is_double ? view.far.data[i] : view.single.data[i];
      // Image edges of the region are those of both layers: they tell of neither.
      space_.edge.data()[i] = is_double ? 1 : edges.data()[i];
    }
    return solve_layer(parameters_.lambda, view.far);
  }

  double solve_foreground(const Image<float>& edges, const LayeredView& view) {
    const auto factor = static_cast<float>(std::max(parameters_.layer_smoothness, 1.0));
    for (int y = 0; y < region_.height(); ++y) {
      const std::uint8_t* here = region_.row(y);
      const std::uint8_t* below = region_.row(std::min(y + 1, region_.height() - 1));
      for (int x = 0; x < region_.width(); ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * region_.width() + x;
        const bool is_double = here[x] != 0;
        const int right = std::min(x + 1, region_.width() - 1);
        const bool is_border = here[right] != here[x] || below[x] != here[x];
        space_.data.data()[i] = is_double ? view.near.data[i] : view.single.data[i];
        space_.edge.data()[i] = is_border   ? kLayerBorderWeight
                                : is_double ? 1
                                            : edges.data()[i] / factor;
      }
    }
    return solve_layer(parameters_.lambda * factor, view.near);
  }

  double solve_layer(double lambda, ImageView<float> result) {
    return space_.solver
        .solve({space_.data, space_.weight, space_.edge, lambda},
               {parameters_.stop.max_iterations, parameters_.stop.gap}, progress_, result)
        .relative_gap();
  }

  // Orders the layers, and writes confidence and number of layers.
  void finish(const LayeredView& view) {
    for (std::size_t i = 0; i < region_.size(); ++i) {
      float& near = view.near.data[i];
      float& far = view.far.data[i];
      if (region_.data()[i] == 0) {
        near = far;
        view.layers.data[i] = 1;
        continue;
      }
      if (near < far) near = far = 0.5F * (near + far);
      view.coherence.data[i] = confidence(view, i);
      view.layers.data[i] = 2;
    }
  }

  [[nodiscard]] float confidence(const LayeredView& view, std::size_t i) const {
    return static_cast<float>(view.layers.data[i]) / 255;
  }

  const LightField& lf_;
  const EpiTwoLayerParameters& parameters_;
  const Progress& progress_;
  LayerScore score_;
  Workspace space_;
  Image<std::uint8_t> region_;
};

// Steps 2 to 4 of EPI_TWO_LAYER but for the check of lines: decides where there are two layers,
// and smooths both. `packed_views` are packed around the views as far as kMaxArmViews. Returns the
// largest relative duality gap. Throws Cancelled.
double smooth_layers(const LightField& lf, const PackedViews& packed,
                     const EpiTwoLayerParameters& parameters, const LayeredMaps& maps,
                     const Progress& progress) {
  LayeredDisparity& layered = maps.layered;
  const GridShape grid = layered.layers.grid();
  const ViewIndex first = layered.layers.first();
  std::vector<double> gaps(grid.count());
  parallel_for_workers(grid.count(), progress, [&] {
    return [&, smoother = ViewSmoother(lf, packed, parameters, progress)](int i) mutable {
      const ViewIndex view = grid.view_at(i, first);
      gaps[i] = smoother.solve(
          view, {maps.fit.view(view), maps.single.view(view), maps.coherence.view(view),
                 layered.foreground.disparity.view(view), layered.background.disparity.view(view),
                 layered.layers.view(view)});
    };
  });
  return *std::ranges::max_element(gaps);
}

// Clamps overshoot that the tensors left in, and makes the foreground the single map, for methods
// with one layer. Throws Cancelled.
void clamp_layers(const LayeredMaps& maps, Interval range, const Progress& progress) {
  const auto low = static_cast<float>(range.min);
  const auto high = static_cast<float>(range.max);
  ViewStack<float>& field = maps.single;
  ViewStack<float>& near = maps.layered.foreground.disparity;
  ViewStack<float>& far = maps.layered.background.disparity;
  parallel_for(field.grid().count(), progress, [&](int view) {
    const std::size_t begin = view * field.view_size();
    for (std::size_t i = begin; i < begin + field.view_size(); ++i) {
      far.data()[i] = std::clamp(far.data()[i], low, high);
      near.data()[i] = std::clamp(near.data()[i], low, high);
      field.data()[i] = near.data()[i];
    }
  });
}

// What a result notes: in how many of its pixels there are two layers, and the largest relative
// duality gap.
std::vector<std::string> layer_notes(std::size_t doubles, std::size_t pixels, double gap) {
  const double share = 100.0 * static_cast<double>(doubles) / static_cast<double>(pixels);
  return {fmt::format(finding_text("layers"), share), gap_note(gap)};
}

std::size_t count_doubles(const ViewStack<std::uint8_t>& layers) {
  return static_cast<std::size_t>(std::count(layers.data(), layers.data() + layers.size(), 2));
}

cuda::LayerSmoothing smoothing_of(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                  Interval range) {
  cuda::LayerSmoothing smoothing;
  smoothing.decision = parameters.decision;
  smoothing.strictness = line_strictness(lf.grid());
  smoothing.region_smoothness = parameters.region_smoothness;
  smoothing.region_iterations = kRegionIterations;
  smoothing.region_gap = kRegionGap;
  smoothing.lambda = parameters.lambda;
  smoothing.layer_smoothness = parameters.layer_smoothness;
  smoothing.weight_power = parameters.weight_power;
  smoothing.min_weight = kLeastLayerWeight;
  smoothing.edge_strength = parameters.edge_strength;
  smoothing.border_weight = kLayerBorderWeight;
  smoothing.max_iterations = parameters.stop.max_iterations;
  smoothing.gap = parameters.stop.gap;
  smoothing.min = static_cast<float>(range.min);
  smoothing.max = static_cast<float>(range.max);
  return smoothing;
}

// Maps of both layers like those of one, not yet filled.
void begin_layers(Estimate& estimate) {
  const ViewStack<float>& like = estimate.field.disparity;
  LayeredDisparity& layered = estimate.layered;
  for (ViewStack<float>* map : {&layered.foreground.disparity, &layered.background.disparity}) {
    *map = ViewStack<float>(like.grid(), like.height(), like.width(), 1, like.first());
  }
  layered.layers =
      ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
}

// EPI_TWO_LAYER on the device, from the samples to the result, once the range is known. `tensor`
// is that of single orientations, with the range. Throws as estimate_epi_two_layer, DeviceFailure.
Estimate two_layers_on_device(const LightField& lf, const EpiTwoLayerParameters& parameters,
                              const LayerSearch& search, ViewSelection views,
                              const Progress& progress) {
  Estimate estimate = begin_orientations(lf, search.single, views, progress.part(0, 0.02));
  begin_layers(estimate);
  LayeredDisparity& layered = estimate.layered;
  const cuda::LayerResults results{layered.foreground.disparity, estimate.field.disparity,
                                   layered.background.disparity, estimate.confidence,
                                   layered.layers};
  std::vector<std::future<void>> pages;
  for (ViewStack<float>* map :
       {&results.near, &results.near_again, &results.far, &results.confidence}) {
    pages.push_back(cuda::begin_pages(*map, progress));
  }
  cuda::DeviceMaps single(estimate.field.disparity), fit(estimate.field.disparity);
  cuda::find_orientations(lf, orientation_settings(lf, search.single, estimate.range), single,
                          progress.part(0.02, 0.08));
  cuda::find_orientations(lf, orientation_settings(lf, search.fit, estimate.range), fit,
                          progress.part(0.08, 0.14));
  progress.step("two orientations");
  const DevicePasses of = device_passes(lf, search.double_scales, search.doubles);
  cuda::DeviceLayers layers(lf, of.passes, of.shears, single, progress.part(0.14, 0.35));
  const LineCheck& lines = parameters.line_check;
  cuda::check_lines(lf, {lines.chooses_sides, lines.is_on}, single, progress.part(0.35, 0.4));
  progress.step("layers");
  const cuda::LayerOutcome outcome =
      cuda::solve_layers(lf, smoothing_of(lf, parameters, estimate.range), {single, layers},
                         std::move(fit), results, progress.part(0.4, 1));
  estimate.notes =
      layer_notes(outcome.doubles, layered.layers.size(), *std::ranges::max_element(outcome.gaps));
  return estimate;
}

// Checks the lines of the single layer, and decides and smooths; returns the largest gap.
double solve_views(const LightField& lf, const EpiTwoLayerParameters& parameters,
                   const ViewStack<float>& fit, Estimate& estimate, const Progress& progress) {
  const PackedViews packed = pack_views(lf, progress.part(0, 0));
  check_lines(packed, parameters.line_check, estimate, progress.part(0, 0.15));
  progress.step("layers");
  return smooth_layers(lf, packed, parameters,
                       {fit, estimate.field.disparity, estimate.confidence, estimate.layered},
                       progress.part(0.15, 1));
}

// Where there are two layers, and how they are smoothed.
Schema<EpiTwoLayerParameters> layers_schema() {
  using P = EpiTwoLayerParameters;
  return Schema<P>()
      .real("decision", &P::decision,
            {"Two-layer threshold",
             "Two layers are assumed where the misfit of one orientation exceeds this fraction of "
             "the misfits of one and of two orientations together"},
            {0.01, 0.99})
      .real("region_smoothness", &P::region_smoothness,
            {"Region smoothness",
             "Weight of the length of the boundary between one layer and two; regions narrower "
             "than twice this are dropped",
             "px"},
            {0.1, 100, true})
      .real("least_distance", &P::least_distance,
            {"Minimum layer distance",
             "Two layers closer to each other than this are treated as one", "px"},
            {0.05, 2})
      .real("lambda", &P::lambda,
            {"Smoothing λ",
             "Weight of the total variation of both layers; larger values are smoother"},
            {0.001, 10, true})
      .real("layer_smoothness", &P::layer_smoothness,
            {"Foreground smoothness",
             "Factor by which the foreground of two layers is smoothed more strongly"},
            {1, 20, true})
      .real("weight_power", &P::weight_power,
            {"Coherence exponent p",
             "The data term is weighted by coherence^p, for two layers by their confidence^p; 0 "
             "weights all pixels equally"},
            {0, 16})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "Outside two-layer regions the total variation is weighted by exp(−β·|gradient of the "
             "view|); 0 ignores image edges"},
            {0, 100});
}

Schema<EpiTwoLayerParameters> epi_two_layer_schema() {
  using P = EpiTwoLayerParameters;
  return layers_schema()
      .real("double_inner_scale", &P::double_inner_scale,
            {"Inner scale, two layers",
             "Standard deviation of the Gaussian applied to the samples before second derivatives",
             "px"},
            {0, 2})
      .real("double_outer_scale", &P::double_outer_scale,
            {"Outer scale, two layers",
             "Standard deviation of the Gaussian window over which two orientations are averaged, "
             "along the EPI",
             "px"},
            {0, 3})
      .real("double_contrast", &P::double_contrast,
            {"Contrast limit, two layers", "Second derivatives above this are attenuated", "1/255"},
            {0.1, 255, true})
      .part(&P::stop, stop_schema())
      .part(&P::line_check, line_check_schema())
      .part(&P::tensor, orientation_schema())
      .search("lambda", {0.05, 0.1, 0.2, 0.4})
      .search("weight_power", {2, 6})
      .search("decision", {0.1, 0.15, 0.25});
}

}  // namespace

Interval search_layer_range(const LightField& lf, const EpiLParameters& parameters,
                            const TensorScales& double_scales, const Progress& progress,
                            Device device, double limit) {
  require_double_grid(lf);
  const Interval single = search_range(lf, parameters.range, progress.part(0, 0.3));
  if (range_source(lf, parameters.range) != RangeSource::Found) return single;
  EpiLParameters coarse = parameters;
  coarse.range = Interval{-limit, limit};
  coarse.shear_step = 1;
  const Estimate estimate =
      estimate_orientations(lf, coarse, ViewSelection::Center, progress.part(0.3, 0.6), device);
  const MapBlock center_view{{lf.center(), {1, 1}}, 0, lf.height()};
  const DoubleLayers layers =
      measure_double_layers(lf, double_scales, {{-limit, limit}, kMinDistance, kTileStride},
                            center_view, progress.part(0.6, 0.97), device);
  Image<float> rows(lf.height(), lf.width()), coherence(lf.height(), lf.width());
  spread_coherence(estimate.confidence.view(lf.center()), rows, coherence);
  const Image<float> steadiness =
      layer_steadiness(layers.near.view(lf.center()), layers.far.view(lf.center()),
                       layers.confidence.view(lf.center()), progress.part(0.97, 1));
  std::vector<float> near, far;
  for (std::size_t i = 0; i < layers.near.size(); ++i) {
    const float confidence =
        static_cast<float>(layers.confidence.data()[i]) / 255 * steadiness.data()[i];
    if (confidence < kSureConfidence) continue;
    if (single_misfit_share(coherence.data()[i], confidence) < kSureShare) continue;
    near.push_back(layers.near.data()[i]);
    far.push_back(layers.far.data()[i]);
  }
  const double looked_at = static_cast<double>(coherence.size()) / kTileStride;
  if (static_cast<double>(near.size()) < kEnoughLayers * looked_at) return single;
  return {std::min(single.min, std::max(-limit, quantile(far, kLayerTail) - kMargin)),
          std::max(single.max, std::min(limit, quantile(near, 1 - kLayerTail) + kMargin))};
}

namespace {}  // namespace

float line_strictness(GridShape grid) {
  const int reach = std::clamp(std::max(grid.u, grid.v) / 2, 1, kMaxArmViews);
  return 3.0F * kMaxArmViews * kMaxArmViews / static_cast<float>(reach * reach);
}

LayerScore::LayerScore(const PackedViews& packed, GridShape grid, double decision)
    : packed_(packed),
      decision_(static_cast<float>(decision)),
      strictness_(line_strictness(grid)),
      residuals_(packed),
      rows_(packed.pixels.height(), packed.pixels.width()),
      coherence_(packed.pixels.height(), packed.pixels.width()) {}

void LayerScore::judge(ViewIndex view, const Maps& maps, ImageView<float> score,
                       ImageView<float> weight) {
  spread_coherence(maps.fit, rows_, coherence_);
  residuals_.begin(view);
  raise_by_line_fit(packed_.pixels.view(view), maps.single, strictness_, residuals_, coherence_);
  const Image<float> steadiness =
      layer_steadiness(maps.near, maps.far, maps.confidence, Progress(1));
  for (std::size_t i = 0; i < coherence_.size(); ++i) {
    const float r = coherence_.data()[i];
    const float c = static_cast<float>(maps.confidence.data[i]) / 255;
    const float share = single_misfit_share(r, c);
    const float doubles =
        share > decision_ ? (share - decision_) / (1 - decision_) : share / decision_ - 1;
    // What is no surface speaks for one layer.
    const float seen = steadiness.data()[i] * (doubles + 1) - 1;
    const float fit = std::max((std::max(r, c) - kNoiseFit) / (1 - kNoiseFit), 0.0F);
    score.data[i] = (fit * seen - kOneLayerWeight) / (fit + kOneLayerWeight);
    weight.data[i] = fit + kOneLayerWeight;
  }
}

Estimate estimate_epi_two_layer(const LightField& lf, const EpiTwoLayerParameters& parameters,
                                ViewSelection views, const Progress& progress, Device device) {
  const LayerSearch search = begin_layer_search(lf, parameters, progress.part(0, 0.1), device);
  if (device == Device::Cuda) {
    return two_layers_on_device(lf, parameters, search, views, progress.part(0.1, 1));
  }
  Estimate estimate = estimate_orientations(lf, search.single, views, progress.part(0.1, 0.15));
  const ViewStack<float> fit =
      estimate_orientations(lf, search.fit, views, progress.part(0.15, 0.2)).confidence;
  const ViewStack<float>& single = estimate.field.disparity;
  const MapBlock whole{{single.first(), single.grid()}, 0, lf.height()};
  DoubleLayers layers = measure_double_layers(lf, search.double_scales, search.doubles, whole,
                                              progress.part(0.2, 0.4));
  LayeredDisparity& layered = estimate.layered;
  layered.foreground.disparity = std::move(layers.near);
  layered.background.disparity = std::move(layers.far);
  layered.layers = std::move(layers.confidence);
  clear_invalid(lf, layered.layers);
  const double gap = solve_views(lf, parameters, fit, estimate, progress.part(0.4, 0.98));
  estimate.notes = layer_notes(count_doubles(layered.layers), layered.layers.size(), gap);
  clamp_layers({fit, estimate.field.disparity, estimate.confidence, layered}, estimate.range,
               progress.part(0.98, 1));
  return estimate;
}

Estimator epi_two_layer_estimator() {
  return make_estimator<EpiTwoLayerParameters>(
      {.id = "epi_two_layer",
       .name = "EPI_TWO_LAYER",
       .summary = "Two superimposed orientations on epipolar plane images: transparent and "
                  "reflective surfaces",
       .reference = "Wanner and Goldluecke 2013 [Ano13]",
       .all_views = true,
       .iterative = true,
       .revision = 7,
       .devices = {Device::Cpu, Device::Cuda},
       .main_parameters = {"range", "lambda", "decision"}},
      epi_two_layer_schema(), estimate_epi_two_layer);
}

}  // namespace episcope
