// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/parallel/progress.h"
#include "engine/disparity/common/packed_views.h"

namespace episcope {

/// Decides for the pixels beside jumps of maps of all views to which side they belong: a silhouette
/// that was carried from another view is right to a pixel at best.
///
/// A pixel whose 5×5 px differ by more than 0.2 px of disparity can take the least or the largest
/// value among them, its own standing for the side that it is on. Each is judged by the mean over
/// the views in which it is visible, by the map of that view (0.2 px nearer hides it), of
/// min(cap, |difference of colour|), samples bilinear; `cap` where none sees it. Costs are averaged
/// over such pixels of 5×5 px by their similarity in colour, and the other side wins if its mean is
/// below 0.95 of the own one. All are judged by the estimate before the call, so that results do
/// not depend on the number of threads. Memory: a copy of the disparity. `cap`: samples in [0, 1],
/// Euclidean norm over the channels. Throws Cancelled.
void choose_carried_sides(const PackedViews& views, float cap, Estimate& estimate,
                          const Progress& progress);

}  // namespace episcope
