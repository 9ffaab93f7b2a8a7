// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/pixel_features.h"
#include "engine/labeling/regularizer.h"
#include "engine/scenes/builtin.h"
#include "tests/engine/labeling/noisy_labels.h"

#include <algorithm>
#include <cstdint>
#include <string>

namespace episcope::test {

inline constexpr GridShape kGrid{5, 5};
// Weak ones: regularizers are tested, not edges.
inline constexpr EdgeParameters kEdges{.image = 10, .texture = 1};

inline Scene render(const std::string& id, int size = 96) {
  scenes::RenderOptions options;
  options.grid = kGrid;
  options.height = options.width = size;
  return scenes::render_builtin(id, options, Progress());
}

// A scene, what is said of its labels, and its edges.
struct Case {
  explicit Case(const std::string& id, double share = 0.4, int size = 96)
      : scene(render(id, size)),
        probabilities(mistaken(scene.truth->labels, share)),
        edges(edge_probabilities(*scene.light_field, scene.truth->field, kEdges, Progress())) {}

  [[nodiscard]] RayLabelingInput input() const {
    return {&probabilities, &scene.truth->field, &edges, scene.light_field.get()};
  }
  [[nodiscard]] RayLabeling label(Regularizer regularizer, RayLabelingParameters parameters = {},
                                  int threads = 0) const {
    return label_rays(input(), regularizer, parameters, Progress(threads));
  }
  [[nodiscard]] double right(const RayLabeling& labeling) const {
    return accuracy(labeling.labels, scene.truth->labels);
  }

  Scene scene;
  LabelProbabilities probabilities;
  ViewStack<float> edges;
};

inline bool same(const ViewStack<std::int32_t>& a, const ViewStack<std::int32_t>& b) {
  return a.size() == b.size() && std::equal(a.data(), a.data() + a.size(), b.data());
}

}  // namespace episcope::test
