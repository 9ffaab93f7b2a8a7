// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"

#include <filesystem>
#include <string>

namespace episcope {

/// Whether a path names a result: a result file, another HDF5 file with maps and no light field, a
/// PFM, a TIFF. False for built-in scenes and for what does not exist. Throws IoError if it is a
/// damaged HDF5 file.
[[nodiscard]] bool names_result(const std::string& path);

/// Reads a result of this light field. Throws IoError, also for a file that holds a light field or
/// depth, which would else be judged as disparity.
[[nodiscard]] Estimate read_result_of(const LightField& light_field,
                                      const std::filesystem::path& path);

/// Reads a result without its light field: a result file knows the places of its views; a map from
/// elsewhere becomes view 0,0. Throws IoError.
[[nodiscard]] Estimate read_result_alone(const std::filesystem::path& path);

/// Throws InvalidInput, naming `file`, if an estimate that was read from there has not the size and
/// views of the light field.
void check_fits(const Estimate& estimate, const LightField& light_field, const std::string& file);

/// Whether a result says that it was estimated from other samples than those of this light field.
/// Reads all samples.
[[nodiscard]] bool is_of_other_samples(const Estimate& estimate, const LightField& light_field);

}  // namespace episcope
