// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/user_folders.h"

#include "engine/core/array/memory_budget.h"

#include <unistd.h>

#include <cstdlib>
#include <system_error>

namespace episcope {
namespace {

std::filesystem::path user_folder(const char* variable, const char* below_home) {
  const char* named = std::getenv(variable);
  // The specification has relative paths ignored.
  if (named && std::filesystem::path(named).is_absolute()) {
    return std::filesystem::path(named) / "episcope";
  }
  const char* home = std::getenv("HOME");
  return home && *home ? std::filesystem::path(home) / below_home / "episcope"
                       : std::filesystem::path();
}

/// Whether a folder that need not exist yet could be made and written to.
bool can_be_written(std::filesystem::path folder) {
  std::error_code error;
  while (!folder.empty() && !std::filesystem::exists(folder, error)) {
    const std::filesystem::path above = folder.parent_path();
    if (above == folder) return false;
    folder = above;
  }
  return access(folder.c_str(), W_OK | X_OK) == 0;
}

}  // namespace

std::filesystem::path default_cache_folder() {
  return user_folder("XDG_CACHE_HOME", ".cache");
}

void use_cache_for_scratch() {
  const std::filesystem::path cache = default_cache_folder();
  if (!cache.empty() && can_be_written(cache)) set_scratch_folder(cache / "scratch");
}

std::filesystem::path default_state_folder() {
  return user_folder("XDG_STATE_HOME", ".local/state");
}

std::filesystem::path default_journal_folder() {
  const std::filesystem::path state = default_state_folder();
  return state.empty() ? state : state / "journals";
}

std::filesystem::path default_workspace_folder() {
  const std::filesystem::path state = default_state_folder();
  return state.empty() ? state : state / "sessions";
}

}  // namespace episcope
