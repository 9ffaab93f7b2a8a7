// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/simplex/simplex_race.cuh"

namespace episcope::cuda {

/// One iteration of every problem that is not solved, as SimplexKernel's moves of all rows: u with
/// the duals as they were, then the duals; only on layers that take part in the race, unless that
/// is null. Throws DeviceFailure.
void move_simplex(const SimplexFields& fields, SolvedMask solved, const SimplexRace* race,
                  const DeviceStream& stream);

}  // namespace episcope::cuda
