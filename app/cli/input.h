// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/job.h"
#include "engine/core/estimate.h"
#include "engine/core/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::cli {

/// How to read an INPUT: overrides of what the reader finds out by itself.
struct ReadOptions {
  std::string flip = "auto";
  std::string units = "auto";
  std::string pattern;
  bool is_snake = false;
};

void declare_read_options(Arguments& arguments, ReadOptions& options);

/// Opens an INPUT of the command line. Built-in scenes are kept in the user's cache folder.
/// Throws UsageError for an unknown built-in scene, IoError, Cancelled.
[[nodiscard]] Scene load_input(const std::string& input, const ReadOptions& options,
                               const Progress& progress);

/// Whether an argument names a result: a result file, a PFM, a TIFF.
[[nodiscard]] bool names_result(const std::string& argument);

/// Reads a result without its light field: a result file knows the places of its views; a map from
/// elsewhere becomes view 0,0. Throws IoError.
[[nodiscard]] Estimate read_result_alone(const std::filesystem::path& path);

/// The INPUT that a result was estimated from, as its file says; empty if there is none or it is
/// not where it was.
[[nodiscard]] std::string source_of(const Estimate& estimate);

/// Notes that the estimate was made from other samples than those of the light field, if so.
void note_other_source(const Estimate& estimate, const LightField& light_field, Job& job);

/// Refuses an output file that cannot be written, before hours are spent. Throws IoError.
void check_output_file(const std::filesystem::path& path);

/// Extension in lower case with its dot.
[[nodiscard]] std::string suffix_of(const std::filesystem::path& path);

/// "4,4".
[[nodiscard]] std::string view_text(ViewIndex view);

}  // namespace episcope::cli
