// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/disparity_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/labeling/label_probabilities.h"
#include "engine/labeling/rays/ray_colors.h"

#include <array>

namespace episcope {

/// −log max(p, floor) of each probability as it is stored, 0 … 255.
using CostTable = std::array<float, 256>;
[[nodiscard]] CostTable cost_table(double floor);

/// Costs `[y][label][x]` of the labels of one view by its own probabilities. `costs` has their
/// shape.
void fill_costs(VolumeView<const std::uint8_t> probabilities, const CostTable& table,
                VolumeView<float> costs);

/// Side of the square of views that are nearest to one.
inline constexpr int kNearViews = 5;

/// Which rays of a scene point contribute.
enum class TrackViews {
  All,   ///< Those of all views.
  Near,  ///< Those of the nearest kNearViews² views.
};

/// What fill_track_costs gathers from: everything is borrowed.
struct TrackSources {
  const LabelProbabilities& probabilities;
  const DisparityField& disparity;
  ViewIndex view;
  TrackViews others = TrackViews::All;
  const RayColors* colors = nullptr;  ///< Null = all rays are trusted.
};

/// Costs of the labels of one view, each the mean of the costs of the ray itself and of the rays of
/// the same scene point in other views that have probabilities and disparity
/// (engine/labeling/rays/ray_targets.h), weighted by the trust in their colours. The floor of the
/// table limits the influence of a single stray ray. `costs` has the shape of the view's
/// probabilities. Rows are processed in parallel. Precondition: probabilities and disparity hold
/// the view. Throws Cancelled.
void fill_track_costs(const TrackSources& sources, const CostTable& table, const Progress& progress,
                      VolumeView<float> costs);

}  // namespace episcope
