// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/job.h"
#include "engine/core/light_field/scene.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// How to read an INPUT: overrides of what the reader finds out by itself.
struct ReadOptions {
  std::string flip = "auto";
  std::string units = "auto";
  std::string pattern;
  bool is_snake = false;
  std::string focus = "0";
  bool needs_truth = true;  ///< Whether truth and labels are wanted.
};

void declare_read_options(Arguments& arguments, ReadOptions& options);

/// Declares the options that every verb with an INPUT has, after its own, and parses. Returns and
/// throws as `Arguments::parse`.
[[nodiscard]] bool parse_reading(Arguments& parser, const std::vector<std::string>& arguments,
                                 JobOptions& job, ReadOptions& read);

/// Refuses an INPUT that cannot be there, before anything is done. Throws UsageError for an unknown
/// built-in scene, IoError for a path that does not exist.
void check_input(const std::string& input);

/// Opens an INPUT of the command line. Built-in scenes are kept in the user's cache folder.
/// Throws UsageError for an unknown built-in scene, IoError, Cancelled.
[[nodiscard]] Scene load_input(const std::string& input, const ReadOptions& options,
                               const Progress& progress);

}  // namespace episcope::cli
