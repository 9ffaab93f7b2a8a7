// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/device/device_stream.cuh"
#include "engine/cuda/ordering/lines.cuh"
#include "engine/cuda/ordering/ordering.h"

#include <cstdint>

namespace episcope::cuda {

/// As engine/solvers/ordering/ordering_terms.h.
struct DevicePenalty {
  float rise = 0, fall = 0.1F, softness = 0.05F;
};

/// The views to be improved, by their numbers, and the maps of all.
struct OrderedViews {
  OrderedMaps maps;
  const int* numbers = nullptr;
  int count = 0;
  const float* u = nullptr;
  const float* observed = nullptr;
  const float* weights = nullptr;
  const float* edges = nullptr;
  const std::uint8_t* counts = nullptr;  ///< `[view]`: whether lines that end there count.
};

/// ½ w (u − f)² and the majoriser of the ordering as one weighted observation for each view, and
/// its edges: `[number][y][x]`.
struct OrderedProblem {
  float* f;
  float* w;
  float* g;
};
void majorise(const OrderedViews& views, const DevicePenalty& penalty,
              const OrderedProblem& problem, const DeviceStream& stream);

/// Waits for the stream.
[[nodiscard]] OrderedLines count_lines(const OrderedMaps& maps, const float* u, float limit,
                                       const DeviceStream& stream);

}  // namespace episcope::cuda
