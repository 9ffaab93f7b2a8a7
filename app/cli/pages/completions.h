// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/pages/verb_pages.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// Completion of verbs, options, methods with their parameters, and the words that options take;
/// where none of these is asked for, of files.
[[nodiscard]] std::string bash_completion(const std::vector<VerbPage>& verbs);
[[nodiscard]] std::string zsh_completion(const std::vector<VerbPage>& verbs);
[[nodiscard]] std::string fish_completion(const std::vector<VerbPage>& verbs);

}  // namespace episcope::cli
