// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/simplex_moves.cuh"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace episcope::cuda {

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
