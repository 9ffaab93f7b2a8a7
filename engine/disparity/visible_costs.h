// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/cuda/device.h"
#include "engine/disparity/global_labeling.h"
#include "engine/disparity/matching_cost.h"
#include "engine/disparity/stereo_costs.h"

namespace episcope {

/// Parts of the cap ε of a pixel.
struct LocalCapOptions {
  float offset = 0.03F;  ///< Error of disparity that is still to cost its due, px.
  float noise_share = 2;
  /// In three channels; in one, 1/√3 of them.
  float lowest = 0.01F;
  float highest = 0.015F;
};

/// ε at each pixel of a view, `[y][x]`: what a disparity that is off by `offset` px costs there,
/// the mean over all views of |I(x + offset·v) − I(x)| to first order, within [lowest, highest],
/// and `noise_share` standard deviations of the noise. Samples in [0, 1], Euclidean norm over the
/// channels. `variance`: of the noise, `[y][x]`. Throws Cancelled.
[[nodiscard]] Image<float> local_caps(const LightField& light_field, ViewIndex view,
                                      const Image<float>& variance, const LocalCapOptions& options,
                                      const Progress& progress);

/// The mean of a confidence over the 9×9 px around each pixel: single pixels say little of how far
/// noise leaves labels apart.
[[nodiscard]] Image<float> regional_trust(ImageView<const float> confidence);

/// The matching costs of all labels of one view, where they were computed: on the CPU or on the
/// device. Immutable; refers to the data term, which must outlive it.
class LabelCosts {
 public:
  /// `[y][label][x]`. Throws Cancelled.
  LabelCosts(const StereoCosts& stereo, Volume<float> volume, const Progress& progress);
  LabelCosts(const StereoCosts& stereo, cuda::SharedVolume volume);

  [[nodiscard]] const StereoCosts& stereo() const { return stereo_; }
  /// The costs on the device; null = they are on the CPU.
  [[nodiscard]] const cuda::SharedVolume& on_device() const { return on_device_; }
  /// The costs on the CPU; empty if they are on the device.
  [[nodiscard]] VolumeView<const float> on_cpu() const { return volume_.view(); }

  /// The label of least cost at each pixel, of equals the lowest. Throws DeviceFailure, Cancelled.
  [[nodiscard]] Image<int> best_labels(const Progress& progress) const;
  /// Places all pixels between labels: place_by_costs. Throws DeviceFailure, Cancelled.
  [[nodiscard]] Placements place(const Image<int>& labels, const Progress& progress) const;
  /// volume_confidence. Throws DeviceFailure, Cancelled.
  [[nodiscard]] ViewStack<float> confidence(ImageView<const float> disparity,
                                            const Progress& progress) const;

 private:
  const StereoCosts& stereo_;
  Volume<float> volume_;
  Image<float> means_;
  cuda::SharedVolume on_device_;
};

/// Parameters of visibility and caps.
struct VisibilityParameters {
  int rounds = 2;            ///< Times that costs are computed anew with what occludes what.
  double tolerance = 0.2;    ///< Occluders::tolerance, px.
  double least_trust = 0.1;  ///< Of surfaces that occlude, mean over their surroundings.
  double cap_share = 0.7;    ///< Of StereoCosts' ε that is the least cap of a pixel.
  double cap_offset = 0;     ///< LocalCapOptions::offset, px; 0 = one cap for all pixels.
};
[[nodiscard]] Schema<VisibilityParameters> visibility_schema();

/// Unless `cap_offset` is 0, gives every pixel a cap of its own (local_caps), at least a share of
/// the ε found for the whole view. Throws Cancelled.
void set_local_caps(const LightField& light_field, const VisibilityParameters& parameters,
                    const Progress& progress, StereoCosts& costs);

/// The disparities whose confidence, mean over its surroundings (regional_trust), is at least
/// `least_trust`; elsewhere kNothingNear.
[[nodiscard]] Image<float> sure_surfaces(ImageView<const float> disparity,
                                         ImageView<const float> confidence, double least_trust);

/// Excludes views in which a sure surface occludes a point from its costs. Throws
/// Cancelled.
void set_occluders(const LightField& light_field, ImageView<const float> disparity,
                   ImageView<const float> confidence, const VisibilityParameters& parameters,
                   const Progress& progress, StereoCosts& costs);

/// The costs of all rows (stereo_volume), where the data term has them computed; with caps of
/// single pixels, costs are divided by the cap of their pixel and multiplied by the mean cap: a
/// smooth region whose noise is low then says as much as one of strong contrast, and is not
/// overruled by the smoothness. They refer to `costs`. Throws DeviceFailure, Cancelled.
[[nodiscard]] LabelCosts visible_costs(const LightField& light_field, const StereoCosts& costs,
                                       const Progress& progress);

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
