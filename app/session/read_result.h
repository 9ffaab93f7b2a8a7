// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"

#include <filesystem>

namespace episcope {

/// Whether an HDF5 file holds what only comes with a light field: samples or true depth. False for
/// files of other kinds. Throws IoError if it is damaged.
[[nodiscard]] bool holds_light_field(const std::filesystem::path& path);

/// Reads a result of this light field. Throws IoError, also for a file that holds a light field or
/// depth, which would else be judged as disparity.
[[nodiscard]] Estimate read_result_of(const LightField& light_field,
                                      const std::filesystem::path& path);

/// Whether a result says that it was estimated from other samples than those of this light field.
/// Reads all samples.
[[nodiscard]] bool is_of_other_samples(const Estimate& estimate, const LightField& light_field);

}  // namespace episcope
