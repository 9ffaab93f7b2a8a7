// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"
#include "engine/cuda/device.h"

#include <functional>
#include <vector>

namespace episcope {

/// How a disparity is interpolated between labels from the costs of its label and the two
/// neighboring labels: not at all, at the vertex of a parabola, or where two lines of equal slope
/// meet (for costs like |·|).
enum class Refinement { None, Parabola, Equiangular };
[[nodiscard]] Names<Refinement> names_of(Refinement);

/// The position of the minimum, in labels from the middle one, at most half a label away. 0 where
/// the costs are not convex.
[[nodiscard]] float sub_label_offset(float before, float here, float after, Refinement refinement);

/// Parameters that the global methods ST_*_G and EPI_G share; defaults are each method's.
struct GlobalLabelingParameters {
  double smoothness = 0.9;
  double edge_strength = 25;
  double settling = 1;
  int max_iterations = 500;
  double gap = 1e-3;
};
[[nodiscard]] Schema<GlobalLabelingParameters> global_labeling_schema();
/// The values that weigh all variation alike and keep the labels, as the paper.
[[nodiscard]] ParameterSet plain_labeling();

/// The disparity between labels of a pixel with a given label.
struct Placement {
  float disparity = 0;  ///< Near the label's.
  float weight = 0;     ///< In [0, 1].
};

struct Placements {
  Image<float> disparity, weight;
};
/// Places pixels one by one. Throws Cancelled.
[[nodiscard]] Placements place_pixels(
    const Image<int>& labels, const std::function<Placement(int y, int x, int label)>& place,
    const Progress& progress);

/// The data term of one view, and how pixels are placed once their labels are known.
struct GlobalLabelingData {
  ViewIndex view;
  std::vector<float> labels;     ///< Disparities, equidistant, at least 2.
  VolumeView<const float> cost;  ///< `[y][label][x]`
  double scale = 1;              ///< Of the costs: the smoothness is multiplied by it.
  std::function<Placements(const Image<int>& labels, const Progress& progress)> place;
  double noise_variance = 0;     ///< Of the view, to be taken off its gradient.
  cuda::SharedVolume on_device;  ///< The costs, instead of `cost`, for the device; null = none.
};

/// Disparity of one view by a globally optimal labeling (engine/solvers/simplex_labeling.h):
/// min Σ ρ(x, u) + λ·scale·Σ g |∇u|, u in px among the labels, g = exp(−β |∇I|) from the view,
/// without its noise (smoothness_weights).
/// λ·scale, energy, gap and iterations go to the notes of `estimate`, the map to `estimate.field`.
///
/// Labels quantize (variance step²/12) and cause staircases; therefore the map is refined between
/// labels: TV-L2 of the placements with their weights, g from the view as it is and λ = `settling`
/// label steps, which smooths slopes under noise less (tests/accuracy/tuning.md), at most one step
/// from the label. `settling` 0 keeps the labels. With costs on the device both are computed there.
/// Throws InvalidInput, DeviceFailure, Cancelled; ends early at `progress.finish_requested()`.
/// Reference: Pock, Cremers, Bischof, Chambolle 2010 [PCBC10].
void label_globally(const LightField& light_field, const GlobalLabelingData& data,
                    const GlobalLabelingParameters& parameters, Estimate& estimate,
                    const Progress& progress);

}  // namespace episcope
