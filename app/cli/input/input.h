// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/arguments/parameter_options.h"
#include "app/cli/output/job.h"
#include "engine/core/light_field/scene.h"
#include "engine/io/open/open_options.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// The options by which every verb reads an INPUT (io::open_schema).
struct ReadOptions {
  ParameterOptions options;
  bool needs_truth = true;  ///< Whether truth and labels are wanted.
};

void declare_read_options(Arguments& arguments, ReadOptions& options);

/// Declares the options that every verb with an INPUT has, after its own, and parses. Returns and
/// throws as `Arguments::parse`.
[[nodiscard]] bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments,
                                 JobOptions& job, ReadOptions& read);

/// Throws UsageError for an unknown id, naming the nearest.
void check_builtin_scene(const std::string& id);

/// Refuses an INPUT that cannot be there, before anything is done. Throws UsageError for an unknown
/// built-in scene, IoError for a path that does not exist.
void check_input(const std::string& input);

/// Opens an INPUT of the command line. Built-in scenes are kept in the user's cache folder.
/// Throws UsageError for an unknown built-in scene or a bad option, IoError, Cancelled.
[[nodiscard]] Scene load_input(const std::string& input, const ReadOptions& options,
                               const Progress& progress);
/// The same with options of another origin.
[[nodiscard]] Scene load_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                               const Progress& progress);

}  // namespace episcope::cli
