// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/indices.h"
#include "engine/core/parameter.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace episcope::cli {

/// Answers in JSON: objects keep the order in which their keys were added.
using Json = nlohmann::ordered_json;

/// The ends of an interval without digits that only tell of rounding: an end of single precision is
/// the shortest number that reads back as the same.
[[nodiscard]] Json interval_json(const Interval& interval);
[[nodiscard]] Json view_json(ViewIndex view);
/// "2026-11-27T22:43:23Z" of seconds since 1970.
[[nodiscard]] std::string time_text(std::int64_t seconds);
/// The one JSON object of an answer, on standard output.
void print_json(const Json& json);

/// Whether a file that is there may be replaced.
enum class Overwrite { No, Yes };

/// Refuses an output file that cannot be written, before hours are spent. Throws IoError.
void check_output_file(const std::filesystem::path& path);

/// Refuses an output that cannot be written or is not named like HDF5. Throws IoError, UsageError
/// naming the verb.
void check_hdf5_output(const std::string& verb, const std::filesystem::path& path);

/// What a result or labels are to be made by.
struct IntendedRun {
  std::string method;       ///< Id of an estimator; empty for labels.
  ParameterSet parameters;  ///< Those that are not listed have their default.
  std::string input;        ///< As typed.
  ParameterSet reading;     ///< Reading options that are set (io::given_options).
};

/// Refuses to replace anything but a result file, and one of another method, other parameters,
/// another light field or another reading of it unless that is asked for. Parameters that the file
/// does not know count as their default. Throws IoError.
void check_result_output(const std::filesystem::path& path, const IntendedRun& run,
                         Overwrite overwrite);

/// Refuses to replace anything but a file of labels that `label` wrote, and one as above. Throws
/// IoError.
void check_labeling_output(const std::filesystem::path& path, const IntendedRun& run,
                           Overwrite overwrite);

/// Writes a file by `write`, to which it passes the path. Unless `overwrite` says otherwise, a file
/// that is there stays: one of the same bytes as it is, one of others makes this throw IoError. For
/// forms that do not tell what they were made by.
void write_output(const std::filesystem::path& path, Overwrite overwrite,
                  const std::function<void(const std::filesystem::path&)>& write);

/// Prints the line of a file of labels that was written beside the light field `output`; nothing if
/// it is empty or `output` itself.
void print_labels_written(const std::filesystem::path& labels, const std::filesystem::path& output);

/// Refuses to replace a light field, or labels beside it that belong to it, unless that is asked
/// for, and any other file at all. Throws IoError.
void check_light_field_output(const std::filesystem::path& path, Overwrite overwrite);

/// Refuses an output that is the input or one of its files: labels.h5 and other companions of an
/// archive file, the images of a folder. Throws IoError.
void protect_input(const std::filesystem::path& output, const std::string& input);

}  // namespace episcope::cli
