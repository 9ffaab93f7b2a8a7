// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/tensor/best_tensors.cuh"
#include "engine/cuda/tensor/tensor_run.cuh"

namespace episcope::cuda {

/// What becomes of the estimates of a direction.
enum class Outcome {
  Stored,             ///< As they are.
  MergedIntoNothing,  ///< Merged into estimates of 0.
  MergedWithStored    ///< Those of vertical EPIs are in the maps, and are merged into these.
};

/// How results are written.
struct AverageSettings {
  LaneTaps across;
  float noise_energy = 0, min = 0, max = 0;
  Outcome outcome = Outcome::Stored;
  bool takes_winner = false;
  int fusion_power = 0;
  bool is_last = false;  ///< The direction is the last: what is done in the end is done.
  bool squares_coherence = false, clamps = false;
  float clamp_min = 0, clamp_max = 0;
};

/// EPIs of a band that have best tensors, and those of them whose results are wanted.
struct AveragedBand {
  EpiBand band;
  int first = 0, count = 0;  ///< Results: image rows or columns.
  int last_epi = 0;          ///< Of the image: its neighbours are repeated.
};

/// Averages tensors over neighbouring EPIs, reads disparity and coherence off them and writes both
/// to the maps; see OrientationKernel::resolve and merge.
void average_tensors(const DeviceSamples& samples, const AveragedBand& band, WantedViews wanted,
                     const float* best, const AverageSettings& settings, const MapPointers& maps,
                     const DeviceStream& stream);

}  // namespace episcope::cuda
