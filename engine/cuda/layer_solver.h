// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device.h"
#include "engine/cuda/orientations.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace episcope::cuda {

/// How two layers are told from one and smoothed; see EpiTwoLayerParameters.
struct LayerSmoothing {
  double decision = 0.1;
  float strictness = 3;  ///< Of the fit of lines, line_strictness().
  double region_smoothness = 4;
  int region_iterations = 10;
  double region_gap = 1e-3;
  double lambda = 0.1;
  double layer_smoothness = 3;
  double weight_power = 4;
  float min_weight = 0.003F;
  double edge_strength = 15;
  float border_weight = 0.02F;
  int max_iterations = 30;
  double gap = 1e-4;
  float min = 0, max = 0;  ///< Of the results.
};

/// What a run starts from, of the same views, all of the stream of `single`.
struct RawLayers {
  DeviceMaps& single;    ///< One orientation, its lines checked.
  DeviceLayers& layers;  ///< Two orientations.
};

/// Where results go, stacks of the same views: both layers, clamped, and the nearer one once more.
struct LayerResults {
  ViewStack<float>& near;
  ViewStack<float>& near_again;
  ViewStack<float>& far;
  ViewStack<float>& confidence;  ///< Of what is there.
  ViewStack<std::uint8_t>& layers;
};

/// What a run tells besides its results.
struct LayerOutcome {
  std::vector<double> gaps;  ///< Relative, of every view.
  std::size_t doubles = 0;   ///< Rays with two layers.
};

/// Steps 2 to 4 of EPI_TWO_LAYER on the device. `fit` holds the coherence of one orientation before
/// its lines were checked. Throws DeviceFailure, Cancelled.
[[nodiscard]] LayerOutcome solve_layers(const LightField& light_field,
                                        const LayerSmoothing& smoothing, const RawLayers& raw,
                                        DeviceMaps fit, const LayerResults& results,
                                        const Progress& progress);

/// A LiftedProblem (engine/solvers/simplex_labeling.h) on the device, and when to stop.
struct LiftedTask {
  SharedVolume cost;         ///< `[y][label][x]`, at most 512 labels.
  ImageView<const float> g;  ///< `[y][x]`, on the host, contiguous.
  double smoothness = 0;
  int max_iterations = 1000;
  double gap = 1e-3;
  int check_every = 10;
};

/// A LiftedResult.
struct LiftedLabels {
  Image<int> labels;
  int iterations = 0;
  double energy = 0, bound = 0;
  bool converged = false;
};

/// As solve_lifted_labeling: the same iterations, energy, bound and gap; takes 6 floats per pixel
/// and label besides the costs. `report` gets iterations and gap whenever the gap is checked.
/// Throws DeviceFailure, Cancelled.
[[nodiscard]] LiftedLabels solve_lifted(const LiftedTask& task,
                                        const std::function<void(int, double)>& report,
                                        const Progress& progress);

/// MessageProblem on the device (engine/solvers/message_labeling.h).
struct MessageTask {
  const DeviceVolume& cost;  ///< `[y][label][x]`, at most 512 labels.
  ImageView<const float> across, down;
  float slope = 1;
  float most = 1;
};

/// As MessageResult.
struct MessageAnswer {
  Image<int> labels;
  int iterations = 0;
  double energy = 0;
  double bound = 0;
};

/// `solve_by_messages` on the device: rows follow one another a pixel apart. Throws DeviceFailure,
/// Cancelled.
[[nodiscard]] MessageAnswer solve_by_messages(const MessageTask& task, int iterations,
                                              const Progress& progress);

}  // namespace episcope::cuda
