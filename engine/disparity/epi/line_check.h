// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/schema.h"

#include <cstdint>

namespace episcope {

/// Lowers the confidence of local estimates that the views themselves contradict: every element of
/// `estimate.confidence` is multiplied by (t_line·t_texture)^¼, each t in (0, 1]. The fourth root,
/// because a confidence to the power 6 becomes the weight of the data: t² or t³ in the weight give
/// up bars that are one or two pixels wide. Both are aimed at the band beside a silhouette where a
/// window that straddles it answers with the foreground's disparity for pixels of the background
/// (fattening), which coherence alone does not tell.
///
/// t_line = s²/(s² + max(0, e − n²)): e is the mean squared difference of colour between the
/// pixel and its line in up to four neighbouring views to one side, of the four sides the least. In
/// an opaque scene a line is hidden only behind something nearer, and then seldom on all sides: a
/// disparity that no side confirms is wrong. n² is the median of e over the centre view, the
/// noise; s² = (1/255)² + n².
///
/// t_texture = min(1, 4·(own + s²)/(window + s²)): `window` is the mean squared gradient of
/// 5×5 px, `own` that of the pixel, of the two differences along each axis the smaller. A pixel
/// without texture of its own beside a strong edge was given the edge's orientation.
///
/// Measured, MSE×100 of the centre view of EPI_C without sweeps (`sweeps` 0), `check_lines` off and
/// on: bars 3.30, 0.37; objects 0.70, 0.13; demo 1.40, 0.29 (256 px); still_life 1.62, 0.66; cotton
/// 2.79, 0.92; objects with noise of 5/255 0.89, 0.59.
/// The estimate must cover the centre view. Memory: 4 bytes a ray of the light field. Throws
/// Cancelled.
void reduce_confidence(const LightField& light_field, Estimate& estimate, const Progress& progress);

/// The same with views packed before (pack_views), for several estimates of one light field.
void reduce_confidence(const ViewStack<std::uint32_t>& packed_views, Estimate& estimate,
                       const Progress& progress);

/// Whether a method lowers confidence so.
struct LineCheck {
  bool is_on = true;
};
[[nodiscard]] Schema<LineCheck> line_check_schema();

}  // namespace episcope
