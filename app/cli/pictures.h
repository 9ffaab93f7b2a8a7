// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/evaluation/metrics/metrics.h"

#include <optional>
#include <string>

namespace episcope::cli {

/// What to show, where it is not the usual: the centre view, the middle row, the quantity's own
/// range and colour map.
struct PictureOptions {
  std::optional<ViewIndex> view;
  std::optional<int> row;
  std::optional<int> column;
  std::optional<Interval> range;
  std::string color_map;
  int label = 1;      ///< For probabilities: which label, from 1.
  std::string layer;  ///< Of two layers "foreground" or "background"; empty = the first there is.
};

using Picture = Image<std::uint8_t>;

/// RGBA pictures by engine/render, as the window shows them. All throw InvalidInput if the view,
/// row, column, label or the thing itself does not exist; the message begins with the light field.
[[nodiscard]] Picture view_picture(const Scene& scene, const PictureOptions& options);
/// Every row of the EPI is `kEpiRowHeight` pixels high. A vertical EPI stands upright: y downwards,
/// v to the right.
[[nodiscard]] Picture epi_picture(const Scene& scene, const PictureOptions& options);
[[nodiscard]] Picture truth_picture(const Scene& scene, const PictureOptions& options);
[[nodiscard]] Picture labels_picture(const Scene& scene, const PictureOptions& options);
[[nodiscard]] Picture probability_picture(const Scene& scene, const PictureOptions& options);
/// How probable an edge is, from the file beside the light field, else computed from the image and
/// `disparity`, which may be empty (engine/labeling/rays/boundary_weights.h).
[[nodiscard]] Picture edges_picture(const Scene& scene, const DisparityField& disparity,
                                    const PictureOptions& options, const Progress& progress);
inline constexpr int kEpiRowHeight = 8;

/// `scene` may be null: the range is then that of the estimate.
[[nodiscard]] Picture disparity_picture(const Estimate& estimate, const Scene* scene,
                                        const PictureOptions& options);
[[nodiscard]] Picture confidence_picture(const Estimate& estimate, const PictureOptions& options);
/// truth − estimate; pixels that are not judged or missing have the map's own colour.
[[nodiscard]] Picture error_picture(const Evaluation& evaluation, const PictureOptions& options);

}  // namespace episcope::cli
