// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

namespace episcope {

/// A journal of a session that ended unexpectedly, with or without unsaved changes.
struct UnheldJournal {
  std::filesystem::path path;
  std::filesystem::file_time_type last_change;
};

/// Journals in `folder` that no running session holds, the latest first.
[[nodiscard]] std::vector<UnheldJournal> unheld_journals(const std::filesystem::path& folder);

/// The file name suffix of journals.
inline constexpr const char* kJournalSuffix = ".journal";

}  // namespace episcope
