// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/open_scene.h"

namespace episcope {
namespace {

template <class T>
std::size_t bytes_of(const ViewStack<T>& stack) {
  return stack.size() * sizeof(T);
}

std::size_t bytes_of(const DisparityField& field) {
  return bytes_of(field.disparity) + bytes_of(field.valid);
}

}  // namespace

std::size_t byte_size(const Estimate& estimate) {
  const LayeredDisparity& layered = estimate.layered;
  return bytes_of(estimate.field) + bytes_of(estimate.confidence) + bytes_of(layered.foreground) +
         bytes_of(layered.background) + bytes_of(layered.layers);
}

std::size_t byte_size(const OpenScene& scene) {
  std::size_t bytes = 0;
  if (scene.scene) {
    const GroundTruth& truth = *scene.scene->truth;
    const LightField& light_field = *scene.scene->light_field;
    if (!light_field.is_on_disk()) bytes += light_field.byte_size();
    bytes += light_field.beside().bytes();
    bytes += bytes_of(truth.field) + bytes_of(truth.foreground) + bytes_of(truth.background) +
             bytes_of(truth.labels);
  }
  for (const EstimateEntry& each : scene.estimates) {
    if (each.estimate) bytes += byte_size(*each.estimate);
  }
  if (scene.labels.labeling) {
    bytes += bytes_of(scene.labels.labeling->labels);
    for (const ProbabilityMap& map : scene.labels.labeling->probabilities.views) {
      bytes += map.view().size();
    }
  }
  return bytes;
}

}  // namespace episcope
