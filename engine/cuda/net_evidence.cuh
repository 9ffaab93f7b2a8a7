// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/net_layers.cuh"
#include "engine/cuda/net.h"

namespace episcope::cuda {

/// The views that kernels compare, each `[y][x]`: the reference, then sector by sector.
struct NetViewPointers {
  const float4* pixels = nullptr;   ///< R, G, B, the difference of grey along x; NaN where invalid.
  const float* down = nullptr;      ///< The difference along y.
  const float2* offsets = nullptr;  ///< du and dv of each view.
  const int* sector_begin = nullptr;  ///< Sector k from this one to the next one's.
  int height = 0;
  int width = 0;
};

/// The views of a task on the device, and the guide of the reference; see NetEvidence, net_guide.
class NetViews {
 public:
  /// Throws DeviceFailure, Cancelled.
  NetViews(const NetTask& task, const DeviceStream& stream, const Progress& progress);

  [[nodiscard]] int height() const { return pointers_.height; }
  [[nodiscard]] int width() const { return pointers_.width; }

  /// Evidence of the labels of the task in rows [first, end). Throws DeviceFailure.
  [[nodiscard]] NetTensor evidence(const NetTask& task, int first, int end,
                                   const DeviceStream& stream) const;
  /// The guide of these rows.
  [[nodiscard]] NetTensor guide(int first, int end, const DeviceStream& stream) const;

  /// Writes reduced evidence at kNetHypotheses maps, one after the other, to the first channels of
  /// `inputs`, with the weights of a reduction in the order of ordered_reduction.
  void reduce_hypotheses(const float* maps, const float* weights, NetTensor& inputs,
                         const DeviceStream& stream) const;
  /// Likewise at kNetOffsets offsets from one map, `step` px each.
  void reduce_offsets(const float* map, float step, const float* weights, NetTensor& inputs,
                      const DeviceStream& stream) const;

  /// Numbers of the guide, `[channel][y][x]` in the layout of `whole_guide`.
  [[nodiscard]] const NetTensor& whole_guide() const { return guide_; }

 private:
  DeviceArray<float4> colors_;
  DeviceArray<float> down_;
  DeviceArray<float2> offsets_;
  DeviceArray<int> sector_begin_;
  NetTensor guide_;
  NetViewPointers pointers_;
  int views_ = 0;
};

/// Weights and bias of the first convolution of a reduction, then of the second.
[[nodiscard]] std::vector<float> ordered_reduction(const NetReduction& reduction);

}  // namespace episcope::cuda
