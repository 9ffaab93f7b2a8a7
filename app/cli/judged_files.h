// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/input.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// A result and the light field whose truth it is judged against.
struct JudgedFile {
  std::string result;
  std::string truth;
  bool is_own = false;  ///< The result itself names that light field; its samples must be the same.
  std::string problem{};  ///< Why this one of several cannot be judged, if that is known.
};

/// What `results` and `truth` of a command line stand for, light field by light field. A folder of
/// results stands for those below it. Without `truth`, a result is judged against the light field
/// that it names. If `truth` is a folder of light fields, each result belongs to the one that it
/// names, else to the one whose name its own begins with or its folder has; a submission to the
/// 2016 benchmark to each that it has a map of. Results of none are noted and left out.
/// Throws UsageError for a result that does not name its light field, IoError for a single one that
/// is damaged or whose light field is gone, or if nothing is left; Cancelled.
[[nodiscard]] std::vector<JudgedFile> judged_files(const std::vector<std::string>& results,
                                                   const std::string& truth,
                                                   const ReadOptions& options, Job& job);

}  // namespace episcope::cli
