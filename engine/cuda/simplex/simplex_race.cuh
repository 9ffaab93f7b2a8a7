// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/simplex/simplex_fields.cuh"

#include <cstddef>
#include <cstdint>

namespace episcope::cuda {

/// A tile of RacingLayers (engine/solvers/simplex/racing_layers.h).
inline constexpr int kRaceColumns = 128, kRaceRows = 8;

/// Which layers take part where, as RacingLayers; borrowed.
struct SimplexRace {
  int across = 0, down = 0, layers = 0;  ///< Tiles of a problem, and layers.
  std::uint8_t* near = nullptr;          ///< `[problem][tile][layer]`
  std::uint16_t* lists = nullptr;        ///< `[problem][tile][kind]`: their number, then layers.

  enum Kind { Moving, Paired, Kinds };
  /// The list of the tile of a pixel.
  [[nodiscard]] __device__ const std::uint16_t* list(int problem, int y, int x, Kind kind) const {
    return lists + list_begin(problem, y / kRaceRows, x / kRaceColumns, kind);
  }
  [[nodiscard]] __host__ __device__ long tile(int problem, int row, int column) const {
    return (static_cast<long>(problem) * down + row) * across + column;
  }
  [[nodiscard]] __host__ __device__ long list_begin(int problem, int row, int column,
                                                    int kind) const {
    return (tile(problem, row, column) * Kinds + kind) * (layers + 1);
  }
};

/// Room for the races of several problems.
class SimplexRaceMemory {
 public:
  SimplexRaceMemory() = default;
  SimplexRaceMemory(const SimplexFields& fields, const DeviceStream& stream);
  [[nodiscard]] const SimplexRace& race() const { return race_; }
  /// Chooses layers less than `behind` dearer than the cheapest, and those of `labels`, and clears
  /// u and the duals of the others, and all that is `ahead`. Throws DeviceFailure.
  void choose(const SimplexFields& fields, const std::int32_t* labels, float behind,
              const DeviceStream& stream);

 private:
  SimplexRace race_;
  DeviceArray<std::uint8_t> near_;
  DeviceArray<std::uint16_t> lists_;
};

/// labels[problem][pixel] = the one at `places`, or at its own place where that is −1.
void move_labels(const SimplexFields& fields, const std::int32_t* labels,
                 const std::int32_t* places, std::int32_t* moved, const DeviceStream& stream);

}  // namespace episcope::cuda
