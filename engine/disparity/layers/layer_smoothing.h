// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/layers/epi_two_layer.h"

namespace episcope {

/// Whole maps of some views, raw, which the results replace: the single orientation and its
/// coherence after lines were checked, the foreground and background of double orientations, and
/// their confidence in 1/255 in place of the number of layers.
struct LayeredMaps {
  const ViewStack<float>& fit;  ///< Coherence of single orientations before lines were checked.
  ViewStack<float>& single;
  ViewStack<float>& coherence;
  LayeredDisparity& layered;
};

/// Steps 2 to 4 of EPI_TWO_LAYER but for the check of lines: decides where there are two layers,
/// and smooths both. `packed_views` are packed around the views as far as kMaxArmViews. Returns the
/// largest relative duality gap. Throws Cancelled.
double smooth_layers(const LightField& light_field, const PackedViews& packed_views,
                     const EpiTwoLayerParameters& parameters, const LayeredMaps& maps,
                     const Progress& progress);

/// Clamps overshoot that the tensors left in, and makes the foreground the single map, for methods
/// with one layer. Throws Cancelled.
void clamp_layers(const LayeredMaps& maps, Interval range, const Progress& progress);

}  // namespace episcope
