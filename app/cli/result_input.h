// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/job.h"
#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/light_field.h"

#include <filesystem>
#include <string>

namespace episcope::cli {

/// Whether an argument names a result: a result file, another HDF5 file with maps and no light
/// field, a PFM, a TIFF.
[[nodiscard]] bool names_result(const std::string& argument);

/// Reads a result without its light field: a result file knows the places of its views; a map from
/// elsewhere becomes view 0,0. Throws IoError.
[[nodiscard]] Estimate read_result_alone(const std::filesystem::path& path);

/// What a result file says of its light field: a built-in scene as it is typed, else a path
/// relative to the folder of the result, so that both can move together; absolute only where they
/// share no folder but the root. Its last part is the name; the hash of the samples is beside it.
[[nodiscard]] std::string source_text(const std::string& input,
                                      const std::filesystem::path& result);

/// The INPUT that the result read from `result` was estimated from, as that file says; empty if
/// there is none or it is not where it was.
[[nodiscard]] std::string source_of(const Estimate& estimate, const std::filesystem::path& result);

/// Notes that the estimate was made from other samples than those of the light field, if so.
void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job);

}  // namespace episcope::cli
