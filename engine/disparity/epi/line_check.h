// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/map_block.h"
#include "engine/core/parallel/progress.h"
#include "engine/core/parameter/schema.h"
#include "engine/disparity/common/packed_views.h"
#include "engine/disparity/common/run_options.h"

#include <vector>

namespace episcope {

/// Lowers the confidence of local estimates that the other views contradict: every element of
/// `estimate.confidence` is multiplied by (t_line·t_texture)^¼, each t in (0, 1]. The fourth root,
/// because a confidence to the power 6 becomes the data weight, and a stricter one would give up
/// bars that are one or two pixels wide. Both factors address the band beside a silhouette where a
/// window that straddles it reports the foreground's disparity for background pixels (foreground
/// fattening), which coherence alone does not detect.
///
/// t_line = s²/(s² + max(0, e − n²)): e is the mean squared colour difference between the pixel and
/// its line in up to four neighbouring views on one side, the minimum over the four sides. In an
/// opaque scene a line can only be hidden by something nearer, and seldom on all sides: a disparity
/// that no side confirms is wrong. n² is the median of e over the centre view, the noise; s² =
/// (1/255)² + n².
///
/// t_texture = min(1, 4·(own + s²)/(window + s²)): `window` is the mean squared gradient over 5×5
/// px, `own` that of the pixel, along each axis the smaller of its two differences. A pixel without
/// texture of its own beside a strong edge has been given the edge's orientation.
///
/// Pixels of other views that are not valid (LightField::valid) do not count for t_line.
///
/// The estimate must cover the centre view. Memory: 4 bytes per ray of the light field. Throws
/// Cancelled. Evidence: tests/accuracy/tuning.md.
void reduce_confidence(const LightField& light_field, Estimate& estimate, const Progress& progress);

/// The same with views that are already packed (pack_views), for several estimates of one light
/// field.
void reduce_confidence(const PackedViews& packed_views, Estimate& estimate,
                       const Progress& progress);

/// The same for maps of any views, given the noise n².
void reduce_confidence(const PackedViews& packed_views, float noise,
                       const ViewStack<float>& disparity, ViewStack<float>& confidence,
                       const Progress& progress);

/// What a method does where the views contradict a local estimate.
struct LineCheck {
  bool chooses_sides = true;  ///< choose_sides
  bool is_on = true;          ///< reduce_confidence
  [[nodiscard]] bool does_anything() const { return chooses_sides || is_on; }
};
[[nodiscard]] Schema<LineCheck> line_check_schema();

/// Does it: sides are chosen first. Throws Cancelled.
void check_lines(const PackedViews& packed_views, const LineCheck& check, Estimate& estimate,
                 const Progress& progress);

/// What a check of some views has to know of the centre view: the noise that sides are chosen by,
/// then the noise that confidence is reduced by. `center` holds the maps of that view.
[[nodiscard]] std::vector<double> line_check_noise(const LightField& light_field,
                                                   const LineCheck& check, BlockMaps center,
                                                   const Progress& progress);
/// Checks whole maps of any views, given that noise; `packed_views` are packed around them as far
/// as kMaxArmViews. Throws Cancelled.
void check_lines(const PackedViews& packed_views, const LineCheck& check,
                 const std::vector<double>& noise, BlockMaps& maps, const Progress& progress);

/// The same, packing the views if need be, on a device. Throws DeviceFailure, Cancelled.
void check_lines(const LightField& light_field, const LineCheck& check, Estimate& estimate,
                 const Progress& progress, Device device = Device::Cpu);

}  // namespace episcope
