// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/simplex/simplex_fields.cuh"

#include <cstdint>

namespace episcope::cuda {

/// Costs and weights of the problems at half the size, as `halve` of
/// engine/solvers/lifted/coarse_layers.h.
void halve_problems(const SimplexFields& fine, const SimplexFields& coarse,
                    const DeviceStream& stream);
/// u = 1 for the cheapest layer of each pixel, of equals the lowest; the duals become 0.
void begin_from_cheapest(const SimplexFields& fields, const DeviceStream& stream);
/// u and duals from those at half the size, as `begin_from`.
void begin_from_coarse(const SimplexFields& coarse, const SimplexFields& fine,
                       const DeviceStream& stream);
/// u and duals of `from`, each pixel those of the place y'·width + x' named for it, `[problem][y]
/// [x]`, −1 for its own; as `begin_from_moved`.
void begin_from_moved(const SimplexFields& from, const std::int32_t* places,
                      const SimplexFields& to, const DeviceStream& stream);

}  // namespace episcope::cuda
