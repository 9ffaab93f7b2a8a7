// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/cuda/simplex/simplex_fields.cuh"

#include <cstdint>

namespace episcope::cuda {

/// What SimplexSolver measures of a problem where its unknowns stand.
struct SimplexMeasure {
  double bound = 0, relaxed = 0, energy = 0;
};

/// Doubles that `measure_simplex` needs for partial sums.
[[nodiscard]] std::size_t partial_sums(const SimplexFields& fields);

/// Writes the labels read off u, `[problem][y][x]`. What is `ahead` is lost. Throws DeviceFailure.
void read_labels(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                 const DeviceStream& stream);
/// Writes these, and what they and the duals are worth, `[problem]`. What is `ahead` is lost. Each
/// sum is taken in one order. Throws DeviceFailure.
void measure_simplex(const SimplexFields& fields, SolvedMask solved, std::int32_t* labels,
                     double* partial, SimplexMeasure* measures, const DeviceStream& stream);

}  // namespace episcope::cuda
