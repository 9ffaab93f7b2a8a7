// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/light_field/device_light_field.cuh"

#include <vector>

namespace episcope::cuda {

/// A band of neighbouring EPIs of one line of cameras. Lanes run along the EPI: x of horizontal
/// ones, y of vertical ones.
struct EpiBand {
  bool is_vertical = false;
  int line = 0;   ///< Camera row v of horizontal EPIs, camera column u of vertical ones.
  int views = 0;  ///< Along the EPI.
  int channels = 0;
  int length = 0;  ///< Lanes of a view.
  int first = 0;   ///< Image row or column of the first EPI of the band.
  int count = 0;   ///< EPIs of the band.
  int margin = 0;  ///< Lanes before and behind a view, whose ends are repeated there.
  int pitch = 0;   ///< Lanes from one EPI to the next.

  [[nodiscard]] __host__ __device__ int center() const { return views / 2; }
  /// Lanes from one view to the next.
  [[nodiscard]] __host__ __device__ int view_stride() const { return count * pitch; }
};

/// Derivatives of the samples smoothed along the EPI, for each lane of each EPI: x holds that along
/// the EPI, y the samples smoothed by Scharr's filter, for the derivative across. First all views
/// at whole pixels, `[channel][view][EPI][lane]`, then half a pixel further, where wanted, views r
/// at an odd distance from the centre in place r/2. Fewer than 2³¹ in all.
struct DerivativePlanes {
  float2* values = nullptr;
  bool with_half = false;

  [[nodiscard]] static long size(const EpiBand& band, bool with_half) {
    const long views = band.views + (with_half ? (band.views + 1) / 2 : 0);
    return views * band.channels * band.count * band.pitch;
  }
  /// Where lane 0 of EPI 0 stands.
  [[nodiscard]] __device__ static int whole(const EpiBand& band, int channel, int view) {
    return (channel * band.views + view) * band.view_stride() + band.margin;
  }
  [[nodiscard]] __device__ static int half(const EpiBand& band, int channel, int view) {
    const int places = (band.views + 1) / 2;
    return (band.channels * band.views + channel * places + view / 2) * band.view_stride() +
           band.margin;
  }
};

/// An odd filter along the EPI.
struct LaneTaps {
  static constexpr int kMaxTaps = 14;
  int count = 0;
  float values[kMaxTaps] = {};
};
[[nodiscard]] LaneTaps lane_taps(const std::vector<float>& taps);

/// Fills the planes of a band. Samples that are not valid are NaN, and so is what they enter.
void differentiate(const DeviceSamples& samples, const EpiBand& band, const LaneTaps& smooth,
                   const DerivativePlanes& planes, const DeviceStream& stream);

}  // namespace episcope::cuda
