// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/pages/verb_pages.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// The page of the manual of `episcope-cli`, in troff.
[[nodiscard]] std::string program_man_page(const std::vector<VerbPage>& verbs);
/// Page of one verb, `episcope-cli-estimate`.
[[nodiscard]] std::string verb_man_page(const VerbPage& verb);
/// Page of the window, around what its `--help` prints.
[[nodiscard]] std::string window_man_page(const std::string& help);

}  // namespace episcope::cli
