// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/rays/view_rays.cuh"
#include "engine/cuda/simplex/simplex_fields.cuh"

#include <cstdint>

namespace episcope::cuda {

/// Which view each problem of a batch is of; of the one solved before, if any.
struct ProblemViews {
  int count = 0;
  std::int16_t view[kMostProblems] = {};
  std::int16_t last[kMostProblems] = {};
};

/// Costs of the labels of each problem's view: of each ray by its own probabilities, or with
/// `near` > 0 the mean over the rays of the same point in the nearest `near`² views, as
/// `fill_track_costs` has it, to the same bits; and the weights of boundaries. Throws
/// DeviceFailure.
void fill_problems(const ViewRays& rays, const ProblemViews& views, int near,
                   const SimplexFields& fields, const DeviceStream& stream);

/// Where the pixels of each problem's view were in the one before, `[problem][y][x]`.
void find_places(const ViewRays& rays, const ProblemViews& views, std::int32_t* places,
                 const DeviceStream& stream);

}  // namespace episcope::cuda
