// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/cuda/device_data.cuh"
#include "engine/cuda/orientations.h"
#include "engine/cuda/tensor.cuh"

#include <functional>

namespace episcope::cuda {

/// Told that maps [first, first + count) will be done when what the stream was told so far is.
using MapsBegun = std::function<void(int first, int count)>;

/// `find_orientations` of what is on the device, on a stream, with the results, disparity and
/// coherence, left there.
/// `on_maps` hears of every map once. Throws DeviceFailure, Cancelled.
void find_orientations_on_device(const DeviceSamples& samples, const TensorSettings& settings,
                                 const MapPointers& maps, const DeviceStream& stream,
                                 const Progress& progress, const MapsBegun& on_maps = {});

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
  int last_epi = 0;          ///< Of the image: its neighbors are repeated.
};

/// Averages tensors over neighboring EPIs, reads disparity and coherence off them and writes both
/// to the maps; see OrientationKernel::resolve and merge.
void average_tensors(const DeviceSamples& samples, const AveragedBand& band, WantedViews wanted,
                     const float* best, const AverageSettings& settings, const MapPointers& maps,
                     const DeviceStream& stream);

}  // namespace episcope::cuda
