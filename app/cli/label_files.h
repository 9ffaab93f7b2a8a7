// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/arguments.h"
#include "app/cli/job.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <string>

namespace episcope::cli {

/// How a verb reads labels of other programs.
struct LabelFileOptions {
  std::string file{};    ///< Or folder; empty = none.
  std::string colors{};  ///< Table, or one of io::shared_colors by name.
  std::string ignored{};
  int first_label = 1;         ///< 0 = 0 is a label.
  bool prefers_truth = false;  ///< As io::LabelReading.
};

/// Declares `--colors`, `--ignore` and `--first-label` beside the option that names the file.
void declare_label_options(Arguments& parser, LabelFileOptions& options);

/// Throws UsageError if an option is given without a file (`option` names it), or for an `--ignore`
/// that is no list of ids.
void check_label_options(const Arguments& parser, const LabelFileOptions& options,
                         const std::string& option);

/// Reads the file or folder for a scene (io::read_labels), and notes how pixels were understood.
/// Throws IoError, Cancelled.
[[nodiscard]] Scribbles load_labels(const LabelFileOptions& options, const Scene& scene, Job& job,
                                    const Progress& progress);

}  // namespace episcope::cli
