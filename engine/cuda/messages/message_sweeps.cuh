// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"

namespace episcope::cuda {

inline constexpr int kWarp = 32;

/// The messages of a labeling: labels of a pixel are contiguous, `[y][x][label]`, padded to whole
/// warps with costs that are never chosen.
struct MessageField {
  int height = 0, width = 0;
  int labels = 0;  ///< Padded.
  const float* cost = nullptr;
  const float* weight_across = nullptr;  ///< `[y][x]` of a pixel and its neighbour to the right,
  const float* weight_down = nullptr;    ///< and of it and the one below.
  float* across = nullptr;               ///< Messages of these edges.
  float* down = nullptr;
  float slope = 1, most = 1;
  int reach = 1;  ///< The first shift, a power of 2, that no difference below the truncation needs.

  [[nodiscard]] __host__ __device__ long pixel(int y, int x) const {
    return static_cast<long>(y) * width + x;
  }
};

/// `[y][label][x]` of `layers` labels to `[y][x][label]`.
void gather_labels(const DeviceStream& stream, const float* volume, int layers,
                   const MessageField& field, float* cost);

/// What a sweep needs besides: how far each row is, and what each row adds to the bound.
struct SweepState {
  int* done;      ///< `[row]`
  double* gains;  ///< `[row]`
  int* labels;    ///< `[y][x]`, of `read_off` alone.
};
/// To the lower right; to the upper left, which fills `gains`; and to the lower right once more,
/// which reads off labels, each given those above and to the left.
void sweep_down(const DeviceStream& stream, const MessageField& field, const SweepState& state);
void sweep_up(const DeviceStream& stream, const MessageField& field, const SweepState& state);
void read_off(const DeviceStream& stream, const MessageField& field, const SweepState& state);

/// The energy of the labels, `[row]`.
void label_energies(const DeviceStream& stream, const MessageField& field, const int* labels,
                    double* energies);

}  // namespace episcope::cuda
