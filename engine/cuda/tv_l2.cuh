// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/tv_l2.h"
#include "engine/cuda/tv_l2_multigrid.cuh"

#include <vector>

namespace episcope::cuda {

/// Many denoising problems of one size on the device, `[view][y][x]`; see TvL2Problem.
struct TvL2Images {
  const float* f = nullptr;
  const float* w = nullptr;  ///< Null = 1.
  const float* g = nullptr;  ///< Null = 1.
  double lambda = 0.1;
};

/// As TvL2Result.
struct TvL2Outcome {
  int iterations = 0;
  double energy = 0, gap = 0;
  bool converged = false;
  [[nodiscard]] double relative_gap() const { return energy > 0 ? gap / energy : 0; }
};

/// TvL2Solver on the device, step by step, for `views` images at once. Each stops for itself.
///
/// An iteration on the level being solved is one kernel: for many pixels it goes down strips of
/// columns and holds the rows that steps still need (iterate_by_strips); for few it takes all
/// pixels at once in tiles (iterate_by_tiles). Each level of multigrid is one kernel down and one
/// up (descend_level, ascend_level). Levels of few pixels are left to one block for each view,
/// which holds them in shared memory and needs no launches (TvL2Tail).
class TvL2DeviceSolver {
 public:
  /// Throws DeviceFailure.
  TvL2DeviceSolver(int height, int width, int views, const DeviceStream& stream);

  /// Writes the minimizers to `u`, `[view][y][x]` on the device, which may be `f`. Ends after the
  /// next iteration at `progress.finish_requested()`. Throws DeviceFailure, Cancelled.
  std::vector<TvL2Outcome> solve(const TvL2Images& problem, int max_iterations, double gap,
                                 const Progress& progress, float* u);

 private:
  void load(const TvL2Images& problem);
  void center();
  void renew_penalty(int stage, bool first);
  void correct(int stage);
  void iterate(int stage, int iteration, const Progress& progress);
  void climb(const Progress& progress);
  void measure();
  void judge(double gap, std::vector<double>& gaps_before);
  [[nodiscard]] TvL2Level level(int k, int stage) const;
  template <class Step>
  void run(const char* name, const Step& step, const TvL2Level& level, double floats,
           double operations);
  template <class Step>
  void run_cells(const char* name, const Step& step, const TvL2Level& coarse, double floats,
                 double operations);

  const DeviceStream& stream_;
  TvL2Grids grids_;
  int first_of_tail_ = 1;
  std::vector<TvL2View> views_;
  std::vector<TvL2Outcome> outcomes_;
  DeviceArray<double> sums_;
  std::vector<double> host_sums_;
};

/// The rectangle of views that maps `[v][u][y][x]` cover.
struct MappedViews {
  GridShape grid;
  ViewIndex first;
};

/// `denoise_maps` of what is on the device already, on a stream. Throws DeviceFailure, Cancelled.
[[nodiscard]] std::vector<double> denoise_on_device(const DeviceSamples& samples,
                                                    const MappedViews& views,
                                                    const MapDenoising& denoising,
                                                    const float* confidence, float* disparity,
                                                    const DeviceStream& stream,
                                                    const Progress& progress);

/// The weights of the data and of the variation for `count` views from number `first` on,
/// `[view][y][x]`: DataWeight with MapDenoising::map_noise, and smoothness_weights.
struct DenoisingWeights {
  float* data;
  float* edges;
};
void fill_weights(const DeviceSamples& samples, const MappedViews& views, int first, int count,
                  const MapDenoising& denoising, const float* confidence, const float* disparity,
                  const DenoisingWeights& weights, const DeviceStream& stream);

}  // namespace episcope::cuda
