// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/cuda/device/device_volume.h"
#include "engine/disparity/common/global_labeling.h"
#include "engine/disparity/stereo/stereo_costs.h"

namespace episcope {

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

}  // namespace episcope
