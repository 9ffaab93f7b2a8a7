// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/disparity/estimator.h"
#include "engine/disparity/view_samples.h"

namespace episcope {

/// Replaces the disparity of rays that other views see through. In an opaque scene the line of a
/// visible point meets, in any other view, the same point or something nearer. A ray whose line
/// meets something farther by more than 0.1 px, of at least its own confidence, in a quarter of
/// up to 16 views (four on each side in its row and column of the grid), at least two, takes the
/// median of the disparities met there, unless that contradicts the samples: its residual
/// (LineResiduals) may exceed the residual of the ray's own disparity by 0.3·(n² + 1/255²) at most,
/// n² the residual noise of the center view (residual_noise). All rays are judged by the
/// disparities before the call, so the order of processing does not matter.
///
/// This moves an edge that all views show with the motion of the background, where no step of a
/// view-by-view descent would lower the number of violations. Confidence and samples must count:
/// otherwise thin bars that some views have lost are eaten away.
/// Both stacks have the same shape and cover all views; `disparity` is finite. Memory: 4 bytes per
/// ray. Returns the number of rays changed. Throws Cancelled.
long replace_occluded(const PackedViews& packed_views, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress);

/// Noise of the center view that rays are judged by, from its packed views and disparity.
[[nodiscard]] float replacement_noise(const PackedViews& packed_views, ViewIndex center,
                                      ImageView<const float> disparity);
/// Replaces rays in the views of `disparity`, given that noise. Maps and packed views cover four
/// views around each of them in its row and column.
long replace_occluded(const PackedViews& packed_views, float noise, const ViewStack<float>& before,
                      const ViewStack<float>& confidence, ViewStack<float>& disparity,
                      const Progress& progress);

/// Packs the views first and replaces rays on a device. Throws DeviceFailure, Cancelled.
void replace_occluded(const LightField& light_field, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress, Device device);

}  // namespace episcope
