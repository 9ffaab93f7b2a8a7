// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/parameter.h"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace episcope::cli {

/// Answers in JSON: objects keep the order in which their keys were added.
using Json = nlohmann::ordered_json;

/// The ends of an interval without digits that only tell of rounding: an end of single precision is
/// the shortest number that reads back as the same.
[[nodiscard]] Json interval_json(const Interval& interval);
[[nodiscard]] Json view_json(ViewIndex view);
/// The one JSON object of an answer, on standard output.
void print_json(const Json& json);

/// Whether a file that is there may be replaced.
enum class Overwrite { No, Yes };

/// Refuses an output file that cannot be written, before hours are spent. Throws IoError.
void check_output_file(const std::filesystem::path& path);

/// Refuses an output that cannot be written or is not named like HDF5. Throws IoError, UsageError
/// naming the verb.
void check_hdf5_output(const std::string& verb, const std::filesystem::path& path);

/// Refuses to replace anything but a result file. Throws IoError.
void check_result_output(const std::filesystem::path& path);

/// Refuses to replace anything but a file of labels that `label` wrote. Throws IoError.
void check_labeling_output(const std::filesystem::path& path);

/// Refuses to replace a light field, or labels beside it that go with it, unless that is asked for,
/// and any other file at all. Throws IoError.
void check_light_field_output(const std::filesystem::path& path, Overwrite overwrite);

/// Refuses an output that is the input or one of its files: labels.h5 and other companions of an
/// archive file, the images of a folder. Throws IoError.
void protect_input(const std::filesystem::path& output, const std::string& input);

}  // namespace episcope::cli
