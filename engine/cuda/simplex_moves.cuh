// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/device.cuh"
#include "engine/solvers/shared_constants.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace episcope::cuda {

/// Of shared memory, what the columns of a block may take.
inline constexpr int kColumnBytes = 48 << 10;

/// Threads of a block that keeps `layers` floats of each of its pixels in shared memory.
[[nodiscard]] constexpr int column_threads(int layers) {
  return layers * 128 * 4 <= kColumnBytes ? 128 : layers * 64 * 4 <= kColumnBytes ? 64 : 32;
}

/// Several problems of one size, `[problem][y][layer][x]`, as SimplexProblem: borrowed.
struct SimplexFields {
  int problems = 0, height = 0, layers = 0, width = 0;
  float *cost = nullptr, *weights = nullptr;  ///< g, `[problem][y][x]`
  float *u = nullptr, *ahead = nullptr, *duals[kPairKinds] = {};
  float limit = 0;  ///< λ/2, the largest size of a dual where g and the pair's share are 1.
  float primal_step = 0, dual_step = 0;

  [[nodiscard]] __host__ __device__ long pixels() const {
    return static_cast<long>(height) * width;
  }
  [[nodiscard]] __host__ __device__ long row() const { return static_cast<long>(layers) * width; }
  /// Layer 0 of a pixel.
  [[nodiscard]] __host__ __device__ long unknown(int problem, int y, int x) const {
    return (static_cast<long>(problem) * height + y) * row() + x;
  }
  [[nodiscard]] __host__ __device__ long pixel(int problem, int y, int x) const {
    return (static_cast<long>(problem) * height + y) * width + x;
  }
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(problems) * static_cast<std::size_t>(height) *
           static_cast<std::size_t>(row());
  }
};

/// The largest size of the duals of the pairs that begin at a pixel, as PairLimits; 0 outside.
struct SimplexLimits {
  float of[kPairKinds];

  __device__ SimplexLimits(const SimplexFields& fields, int problem, int y, int x) {
    const bool inside = y >= 0 && x >= 0;
    const bool down = y + 1 < fields.height, right = x + 1 < fields.width;
    const float here = inside ? fields.limit * fields.weights[fields.pixel(problem, y, x)] : 0.0F;
    const float along =
        kPairSide + kPairDiagonal * static_cast<float>((y == 0 ? 1 : 0) + (down ? 0 : 1));
    const float aside =
        kPairSide + kPairDiagonal * static_cast<float>((x == 0 ? 1 : 0) + (right ? 0 : 1));
    of[0] = right ? here * along : 0;
    of[1] = down ? here * aside : 0;
    of[2] = of[3] = right && down ? here * kPairDiagonal : 0;
  }
};

/// Which problems are solved already, a bit each.
using SolvedMask = std::uint64_t;
inline constexpr int kMostProblems = 64;

/// θ such that Σ_l max(v_l − θ, 0) = 1 of the values `stride` apart, `top` the largest of them; as
/// in layered_kernel.cpp.
__device__ inline float simplex_threshold(const float* values, int stride, int layers, float top) {
  float theta = top - 1.0F;
  for (int pass = 0; pass < layers; ++pass) {
    float sum = -1, count = 0;
    for (int l = 0; l < layers; ++l) {
      const float over = values[l * stride] - theta;
      sum += fmaxf(over, 0.0F);
      count += over > 0.0F ? 1.0F : 0.0F;
    }
    theta += fmaxf(sum / fmaxf(count, 1.0F), 0.0F);
    if (!(sum > 1e-6F)) break;
  }
  return theta;
}

/// What SimplexSolver measures of a problem where its unknowns stand.
struct SimplexMeasure {
  double bound = 0, relaxed = 0, energy = 0;
};

/// Doubles that `measure_simplex` needs for partial sums.
[[nodiscard]] std::size_t partial_sums(const SimplexFields& fields);

/// Writes the labels read off u, `[problem][y][x]`. What is `ahead` is lost. Throws DeviceFailure.
void read_labels(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                 const DeviceStream& stream);
/// Writes these, and what they and the duals are worth, `[problem]`. What is `ahead` is lost. Each
/// sum is taken in one order. Throws DeviceFailure.
void measure_simplex(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                     double* partial, SimplexMeasure* measures, const DeviceStream& stream);

/// A tile of RacingLayers (engine/solvers/layered_sweep.h).
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

/// One iteration of every problem that is not solved, as SimplexKernel's moves of all rows: u with
/// the duals as they were, then the duals; only on layers that take part in the race, unless that
/// is null. Throws DeviceFailure.
void move_simplex(const SimplexFields& fields, SolvedMask solved, const SimplexRace* race,
                  const DeviceStream& stream);

/// Costs and weights of the problems at half the size, as `halve` of
/// engine/solvers/layered_sweep.h.
void halve_problems(const SimplexFields& fine, const SimplexFields& coarse,
                    const DeviceStream& stream);
/// u = 1 for the cheapest layer of each pixel, of equals the lowest; the duals become 0.
void begin_from_cheapest(const SimplexFields& fields, const DeviceStream& stream);
/// u and duals from those at half the size, as `begin_from`.
void begin_from_coarse(const SimplexFields& coarse, const SimplexFields& fine,
                       const DeviceStream& stream);
/// u and duals of `from`, each pixel from the place y'·width + x' named for it, `[problem][y]
/// [x]`, −1 for its own; as `begin_from_moved`.
void begin_from_moved(const SimplexFields& from, const std::int32_t* places,
                      const SimplexFields& to, const DeviceStream& stream);

/// Room for the races of several problems.
class SimplexRaceMemory {
 public:
  SimplexRaceMemory() = default;
  SimplexRaceMemory(const SimplexFields& fields, const DeviceStream& stream);
  [[nodiscard]] const SimplexRace& race() const { return race_; }
  /// Chooses layers less than `behind` dearer than the cheapest, and layers of `labels`; clears
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

/// As SimplexOptions.
struct SimplexSettings {
  double smoothness = 1;  ///< > 0
  double gap = 1e-3;
  int max_iterations = 300;
  int check_every = 10;
  int racing_iterations = 0;
  float behind = 1;
};

/// As SimplexResult.
struct SimplexAnswer {
  int iterations = 0;
  double energy = 0, relaxed = 0, bound = 0;
};

/// Several SimplexProblems of one size and at least two labels, solved side by side by the method
/// of engine/solvers/simplex_labeling.h. One object for many calls, as SimplexSolver.
class SimplexBatch {
 public:
  /// Bytes of the device that each problem takes.
  [[nodiscard]] static std::size_t bytes_of_problem(int height, int layers, int width);

  /// At most kMostProblems. The stream must outlive it. Throws DeviceFailure.
  SimplexBatch(int problems, int height, int layers, int width, const DeviceStream& stream);

  /// Costs and weights, to be written in the order of the stream before each call.
  [[nodiscard]] const SimplexFields& fields() const { return levels_.front().fields; }
  /// Solves the first `count` problems. `places` as in SimplexOptions::from_last, `[problem][y][x]`
  /// on the device; null = afresh. Labels are then in `labels()`. Throws DeviceFailure, Cancelled.
  [[nodiscard]] std::vector<SimplexAnswer> solve(int count, const std::int32_t* places,
                                                 const SimplexSettings& settings,
                                                 const Progress& progress);
  [[nodiscard]] const std::int32_t* labels() const { return best_.data(); }

 private:
  // A size, with what belongs to it.
  struct Level {
    Level(int problems, int height, int layers, int width, const DeviceStream& stream);
    DeviceArray<float> memory;
    SimplexFields fields;
  };
  void set_steps(double smoothness, SimplexFields& fields) const;
  void start(double smoothness);
  void take_over(const std::int32_t* places);
  void choose_layers(const std::int32_t* places, float behind);
  void measure(int count, SolvedMask solved, std::vector<SimplexAnswer>& answers);

  const DeviceStream& stream_;
  std::vector<Level> levels_;  // The finest first.
  std::size_t unknowns_;       // Of the finest, of as many problems as there is room for.
  DeviceArray<float> last_;    // u and duals of the call before, if ever taken over from.
  DeviceArray<std::int32_t> labels_, best_, moved_labels_;
  SimplexRaceMemory race_;
  DeviceArray<double> partial_;
  DeviceArray<SimplexMeasure> measures_;
};

}  // namespace episcope::cuda
