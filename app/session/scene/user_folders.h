// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope {

/// What can be made again: `$XDG_CACHE_HOME/episcope`, else `~/.cache/episcope`; empty if neither
/// is known.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// Has arrays that do not fit into memory go there, to a folder of their own (memory_budget.h);
/// where it cannot be written, they go to the folder for temporary files.
void use_cache_for_scratch();

/// What a session leaves for the next: `$XDG_STATE_HOME/episcope`, else `~/.local/state/episcope`;
/// empty if neither is known.
[[nodiscard]] std::filesystem::path default_state_folder();

/// Where annotation journals lie: `journals` in the state folder; empty likewise.
[[nodiscard]] std::filesystem::path default_journal_folder();

/// Where workspaces lie: `sessions` in the state folder; empty likewise.
[[nodiscard]] std::filesystem::path default_workspace_folder();

}  // namespace episcope
