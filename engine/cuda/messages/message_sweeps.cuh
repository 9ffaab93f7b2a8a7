// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"

namespace episcope::cuda {

inline constexpr int kWarp = 32;
inline constexpr int kMostEach = 16;  ///< Labels of a lane.

/// The messages of a labeling, `[y][x][slot]`: a warp takes a pixel, each of its lanes as many
/// labels that follow one another, padded with costs that are never chosen. Slots are in the order
/// in which a warp reads them: the first label of every lane, the second of every lane, and so on.
struct MessageField {
  int height = 0, width = 0;
  int labels = 0;  ///< Padded.
  const float* cost = nullptr;
  const float* weight_across = nullptr;  ///< `[y][x]` of a pixel and its neighbour to the right,
  const float* weight_down = nullptr;    ///< and of it and the one below.
  float* across = nullptr;               ///< Messages of these edges.
  float* down = nullptr;
  float slope = 1, most = 1;
  int reach = 1;  ///< Lanes beyond which every difference is truncated, a power of 2.

  [[nodiscard]] __host__ __device__ long pixel(int y, int x) const {
    return static_cast<long>(y) * width + x;
  }
  [[nodiscard]] __host__ __device__ int each() const { return labels / kWarp; }
  [[nodiscard]] __host__ __device__ int slot(int label) const {
    return label % each() * kWarp + label / each();
  }
};

/// `[y][label][x]` of `layers` labels to `[y][x][slot]`.
void gather_labels(const DeviceStream& stream, const float* volume, int layers,
                   const MessageField& field, float* cost);

/// Elements of what groups of rows hand to the next one.
[[nodiscard]] std::size_t handed_size(const MessageField& field);
/// Passes messages to the lower right, or to the upper left; fills `gains`, what each row adds to
/// the bound. `handed` is scratch memory.
void sweep_down(const DeviceStream& stream, const MessageField& field, float* handed,
                double* gains);
void sweep_up(const DeviceStream& stream, const MessageField& field, float* handed, double* gains);

/// Labels `[y][x]`, each given those above and to the left.
void read_off(const DeviceStream& stream, const MessageField& field, int* labels);
/// The energy of the labels, `[row]`.
void label_energies(const DeviceStream& stream, const MessageField& field, const int* labels,
                    double* energies);

}  // namespace episcope::cuda
