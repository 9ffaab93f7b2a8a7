// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/layers/layer_search.h"

#include "engine/disparity/common/disparity_range.h"
#include "engine/disparity/layers/layer_range.h"

namespace episcope {
namespace {

// Of two orientations, which are harder to tell from noise than one.
constexpr double kCrossScaleOfLayers = 1;
// Cut off at the range itself, noise about its ends would no longer average out.
constexpr double kOvershoot = 0.3;

}  // namespace

LayerSearch begin_layer_search(const LightField& lf, const EpiTwoLayerParameters& parameters,
                               const Progress& progress, Device device) {
  LayerSearch search;
  search.single = parameters.tensor;
  search.double_scales = {parameters.double_inner_scale, parameters.double_outer_scale,
                          search.single.view_scale,      kCrossScaleOfLayers,
                          parameters.double_contrast,    search.single.noise};
  const Interval range =
      search_layer_range(lf, search.single, search.double_scales, progress, device);
  search.single.range = range;
  search.fit = search.single;
  search.fit.cross_scale = kCrossScaleOfLayers;
  search.doubles = {{range.min - kOvershoot, range.max + kOvershoot}, parameters.least_distance};
  return search;
}

}  // namespace episcope
