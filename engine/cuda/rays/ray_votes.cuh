// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/rays/view_rays.cuh"

#include <cstdint>

namespace episcope::cuda {

/// Labels of all views, `[view][y][x]`, after each ray has taken the label that most rays of its
/// point in its row and column of the grid have: as `vote_along_rays` of
/// engine/labeling/rays/ray_vote.h, to the same bits. Throws DeviceFailure.
void vote_along_rays(const ViewRays& rays, const std::int32_t* labels, std::int32_t* decided,
                     const DeviceStream& stream);

}  // namespace episcope::cuda
