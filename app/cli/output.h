// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/replace_file.h"
#include "engine/core/indices.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::cli {

/// Answers in JSON: objects keep the order in which their keys were added.
using Json = nlohmann::ordered_json;

/// The ends of an interval without digits that only tell of rounding: an end of single precision is
/// the shortest number that reads back as the same.
[[nodiscard]] Json interval_json(const Interval& interval);
[[nodiscard]] Json view_json(ViewIndex view);
/// Code and values of the notes or warnings that are findings (finding_of), in their order.
[[nodiscard]] Json findings_json(const std::vector<std::string>& sentences);
/// "2026-11-27T22:43:23Z" of seconds since 1970.
[[nodiscard]] std::string time_text(std::int64_t seconds);
/// One JSON object on standard output.
void print_json(const Json& json);
/// The JSON answer of a verb, on standard output: its own keys and in any case `results`, a list;
/// `notes`, the sentences of the answer's own key and `notes` (Job::notes), each once; `written`,
/// files and folders. An answer that has no `results` is the only one itself, and is in the list,
/// too. Its own `written` counts more than the parameter.
void print_answer(Json answer, const std::vector<std::string>& notes = {},
                  const std::vector<std::string>& written = {});

/// Refuses an output file that cannot be written, before hours are spent. Throws IoError.
void check_output_file(const std::filesystem::path& path);

/// Refuses an output that cannot be written or is not named like HDF5. Throws IoError, UsageError
/// naming the verb.
void check_hdf5_output(const std::string& verb, const std::filesystem::path& path);

/// A light field and its file of labels, unless that is empty or the light field itself.
[[nodiscard]] std::vector<std::string> files_written(const std::filesystem::path& output,
                                                     const std::filesystem::path& labels);

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
