// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/net_task.h"

#include <vector>

namespace episcope::cuda {

/// Size of a tensor on the device, `[channel][z][y][x]`; rows begin every `pitch` numbers. What
/// lies behind the columns is not defined.
struct TensorShape {
  int channels = 0;
  int depth = 1;
  int height = 0;
  int width = 0;

  static constexpr int kRun = 8;  ///< Columns that a thread computes: rows are a multiple.
  [[nodiscard]] __host__ __device__ int pitch() const { return (width + kRun - 1) / kRun * kRun; }
  [[nodiscard]] __host__ __device__ long plane() const {
    return static_cast<long>(height) * pitch();
  }
  [[nodiscard]] __host__ __device__ long at(int channel, int z, int y, int x) const {
    return (static_cast<long>(channel) * depth + z) * plane() + static_cast<long>(y) * pitch() + x;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(channels) * depth * plane();
  }
};

struct NetTensor {
  TensorShape shape;
  DeviceArray<float> values;

  NetTensor() = default;
  NetTensor(TensorShape size, const DeviceStream& stream)
      : shape(size), values(size.size(), stream) {}
};

/// The steps of a part of the network with their weights, as the kernels want them.
class DevicePart {
 public:
  /// Throws DeviceFailure, Cancelled.
  DevicePart(const NetPart& part, const DeviceStream& stream, const Progress& progress);

  /// Computes all steps from the tensors of its sources, in their order, and returns the last.
  /// Waits for each: a stop is obeyed between two. Throws DeviceFailure, Cancelled.
  [[nodiscard]] NetTensor run(std::vector<NetTensor> sources, const DeviceStream& stream,
                              const Progress& progress) const;

  /// Bytes of the tensors that are held at the same time, at most, for sources of such shapes.
  [[nodiscard]] double bytes(const std::vector<TensorShape>& sources) const;

 private:
  struct Step {
    NetConvolution form;  ///< Without weights.
    int input = -1;
    int before = -1;
    int after = -1;
    int last_use = 0;  ///< The last step that reads it.
    DeviceArray<float> weights, bias;
  };
  [[nodiscard]] TensorShape shape_of(const Step& step, const std::vector<TensorShape>& known) const;
  void convolve(const Step& step, const std::vector<NetTensor>& tensors, NetTensor& out,
                const DeviceStream& stream) const;

  std::vector<Step> steps_;
};

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
