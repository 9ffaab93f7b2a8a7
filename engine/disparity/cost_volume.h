// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/stereo_costs.h"

namespace episcope {

/// The unit in which smoothness is weighed against matching costs: the mean, over the valid pixels
/// of a view, of the mean cost of the labels within 0.5 px of a pixel's best one, at least its two
/// neighbors. It says how much it costs to be off, in the unit of the costs. Labels farther away
/// do not count: the mean over all labels grows with the range that is searched, though nothing
/// supports the labels added.
///
/// `costs` is `[y][label][x]` of the whole view, labels `step` px apart. Throws Cancelled.
[[nodiscard]] double cost_unit(const LightField& light_field, ViewIndex view,
                               VolumeView<const float> costs, double step,
                               const Progress& progress);

/// Computes the unit from costs on the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] double cost_unit(const LightField& light_field, ViewIndex view,
                               const cuda::DeviceVolume& costs, double step,
                               const Progress& progress);

/// How far a volume of matching costs `[y][label][x]` is to be trusted at its pixels.

/// The mean cost of each pixel over the labels. Throws Cancelled.
[[nodiscard]] Image<float> mean_costs(VolumeView<const float> costs, const Progress& progress);

/// The mean of an image over the valid pixels of a view.
[[nodiscard]] double mean_of_valid(const Image<float>& image, const LightField& light_field,
                                   ViewIndex view);

/// 1 − cost / mean cost, in [0, 1]; 0 without costs.
[[nodiscard]] float cost_trust(float cost, float mean);

/// Places a pixel of a label at the parabola through its cost and the costs of the labels beside
/// it, with the square of its trust as weight, at least 0.01.
[[nodiscard]] Placement place_by_costs(const StereoCosts& stereo, VolumeView<const float> costs,
                                       const Image<float>& means, int y, int x, int label);

/// Places all pixels by costs on the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] Placements place_by_costs(const StereoCosts& stereo, const cuda::DeviceVolume& costs,
                                        const Image<int>& labels, const Progress& progress);

/// The trust of each pixel, by the cost of the label nearest to its disparity: one view,
/// `costs.view`. Throws Cancelled.
[[nodiscard]] ViewStack<float> volume_confidence(ImageView<const float> disparity,
                                                 const StereoCosts& stereo,
                                                 VolumeView<const float> costs,
                                                 const Image<float>& means,
                                                 const Progress& progress);

/// Computes the trust from costs on the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] ViewStack<float> volume_confidence(ImageView<const float> disparity,
                                                 const StereoCosts& stereo,
                                                 const cuda::DeviceVolume& costs,
                                                 const Progress& progress);

}  // namespace episcope
