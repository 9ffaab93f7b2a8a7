// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <vector>

namespace episcope {

/// Probability of each label for every pixel of one view, `[y][label][x]`, 0 … 255 for 0 … 1,
/// labels in the order of `LabelProbabilities::ids`. 13 labels of 9×9×768×768 rays take 0.6 GB.
using ProbabilityMap = Volume<std::uint8_t>;

/// Label probabilities of a rectangle of views. Move-only.
struct LabelProbabilities {
  std::vector<std::int32_t> ids;      ///< The label of each layer, ascending.
  GridShape grid;                     ///< Views covered,
  ViewIndex first;                    ///< beginning here: one view alone is a grid of 1×1.
  std::vector<ProbabilityMap> views;  ///< `[v][u]`

  [[nodiscard]] bool empty() const { return views.empty(); }
  [[nodiscard]] bool contains(ViewIndex view) const {
    return !empty() && grid.contains({view.v - first.v, view.u - first.u});
  }
  /// The view whose map is `views[index]`.
  [[nodiscard]] ViewIndex view_at(int index) const { return grid.view_at(index, first); }
  /// Precondition: `contains(view)`.
  [[nodiscard]] const ProbabilityMap& view(ViewIndex view) const { return views[index(view)]; }
  [[nodiscard]] ProbabilityMap& view(ViewIndex view) { return views[index(view)]; }

 private:
  [[nodiscard]] std::size_t index(ViewIndex view) const {
    return static_cast<std::size_t>(view.v - first.v) * grid.u + (view.u - first.u);
  }
};

/// Probabilities of these views and ids, not yet filled.
[[nodiscard]] LabelProbabilities empty_probabilities(const std::vector<std::int32_t>& ids,
                                                     ViewRectangle views);

/// The most probable label of each pixel, `[y][x]`; of equals the lowest id. `ids` names the
/// layers. Throws InvalidInput unless there is one id for each layer.
[[nodiscard]] Image<std::int32_t> most_probable_labels(VolumeView<const std::uint8_t> probabilities,
                                                       const std::vector<std::int32_t>& ids);

/// Uncertainty of the labels of each pixel, `[y][x]` in [0, 1]: the entropy of its probabilities
/// relative to the entropy of equal ones. 0 with a single label.
[[nodiscard]] Image<float> label_uncertainty(VolumeView<const std::uint8_t> probabilities);

}  // namespace episcope
