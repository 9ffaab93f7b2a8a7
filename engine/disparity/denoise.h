// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/cuda/tv_l2.h"
#include "engine/disparity/estimator.h"

#include <string>

namespace episcope {

/// Weights of the total variation, `[y][x]` in (0, 1]: g = exp(−β·|∇I|), small where the view has
/// an edge, so that disparity may jump there. |∇I| is the norm of the forward differences over all
/// channels, samples in [0, 1]; one channel counts as three equal ones (channel_weight). β = 0
/// gives 1 everywhere.
///
/// Noise looks like edges: noise of variance σ² in each of C channels adds 4Cσ² to the mean of
/// |∇I|², which would make the total variation the cheaper the noisier the views are. With
/// `noise_variance` = σ² (local_noise_variance) that much is taken off |∇I|², not below 0.
[[nodiscard]] Image<float> smoothness_weights(const LightField& light_field, ViewIndex view,
                                              double beta, double noise_variance = 0);

/// When TvL2Solver stops.
struct StopParameters {
  int max_iterations = 24;
  double gap = 1e-4;
};
[[nodiscard]] Schema<StopParameters> stop_schema();

/// Parameters of the denoising that EPI_S, EPI_C and ST_*_S share; defaults are each method's.
struct DenoiseParameters {
  double lambda = 0.2;
  double weight_power = 6;
  double edge_strength = 20;
  StopParameters stop = {};
};
[[nodiscard]] Schema<DenoiseParameters> denoise_schema();
/// The values that weigh neither data nor variation, as the paper's denoising.
[[nodiscard]] ParameterSet plain_denoising();

/// The data weight w = max(r^power, minimum) of a pixel of confidence r. No pixel gets weight 0,
/// which keeps the solution unique.
struct DataWeight {
  double power = 2;
  float minimum = 0.01F;
};
void fill_data_weights(ImageView<const float> confidence, DataWeight weight, Image<float>& weights);

/// Denoises every view of `estimate` by itself, in place: min Σ g |∇u| + 1/(2λ) Σ w (u − f)², with
/// f its disparity, w from its confidence r (DataWeight), and g = exp(−β |∇I|) from the view
/// (TvL2Solver). Adds the largest relative duality gap to the notes. Throws Cancelled.
///
/// With a `map_noise` of σ₀ > 0, in px, w grows by the factor 1 + (σ₀/σ − 1)·min(w/0.06, 1), up to
/// 10, where the noise σ of f around a pixel (local_noise_variance) is less than σ₀: what is steady
/// and trusted needs no smoothing, which would flatten its slopes.
///
/// The paper has w = g = 1 ("just performs a TV-L2 denoising"). The weights are an addition: they
/// preserve jumps at image edges and let doubtful pixels follow their neighbors. p = 0 and β = 0
/// give the plain method.
/// Reference: Rudin, Osher, Fatemi 1992 [ROF92].
void denoise(const LightField& light_field, const DenoiseParameters& parameters, Estimate& estimate,
             const Progress& progress, float min_weight = DataWeight{}.minimum, float map_noise = 0,
             Device device = Device::Cpu);

/// How `denoise` weighs its data.
struct DenoiseWeights {
  float min_weight = DataWeight{}.minimum;
  float map_noise = 0;
};

/// Denoises maps of any views; returns the largest relative duality gap.
double denoise(const LightField& light_field, const DenoiseParameters& parameters,
               const DenoiseWeights& weights, ViewStack<float>& disparity,
               const ViewStack<float>& confidence, const Progress& progress);

/// The parameters of `denoise` as the device takes them.
[[nodiscard]] cuda::MapDenoising map_denoising(const DenoiseParameters& parameters,
                                               float min_weight = DataWeight{}.minimum,
                                               float map_noise = 0);

/// The note about the largest relative duality gap of several solutions.
[[nodiscard]] std::string gap_note(double largest);

/// Whether islands are filled.
struct IslandParameters {
  bool islands = true;
};
[[nodiscard]] Schema<IslandParameters> island_schema();
/// The value that keeps islands, as the paper.
[[nodiscard]] ParameterSet plain_islands();

/// Replaces what is too small to be a surface: one pixel, or two neighbors, more than 0.5 px of
/// disparity nearer than all the pixels around them, or farther than all, diagonal neighbors
/// included, take the median of those. A value between its neighbors is the blur of a silhouette
/// and stays. Values that are not finite neither count nor change.
///
/// Why: a dot or a crossing of joints that is smaller than a pixel has another color in every view
/// and matches anywhere by chance; edges on all its sides keep smoothing from joining it to its
/// neighbors (tests/accuracy/tuning.md). Throws Cancelled.
void fill_islands(const Progress& progress, ImageView<float> disparity);
/// Fills islands if the parameters ask for it.
void fill_islands(const IslandParameters& parameters, const Progress& progress,
                  ImageView<float> disparity);

}  // namespace episcope
