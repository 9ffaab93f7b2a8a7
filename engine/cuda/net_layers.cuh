// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device.cuh"
#include "engine/cuda/net.h"

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

}  // namespace episcope::cuda
