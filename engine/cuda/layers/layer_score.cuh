// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/line_check/packed_field.cuh"
#include "engine/cuda/tv_l2/denoise_maps.cuh"

#include <cstdint>

namespace episcope::cuda {

/// What LayerScore judges and fills, of all views `[view][y][x]`: borrowed.
struct ScoredMaps {
  const float *fit = nullptr, *single = nullptr, *near = nullptr, *far = nullptr;
  const std::uint8_t* confidence = nullptr;
  float *score = nullptr, *weight = nullptr;
};

/// Whether rays see two layers or one, as LayerScore (engine/disparity/layers/layer_score.h), of
/// these views of the field. Throws DeviceFailure.
void score_layers(const PackedField& field, const MappedViews& views, float decision,
                  float strictness, const ScoredMaps& maps, const DeviceStream& stream);

}  // namespace episcope::cuda
