// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/document/unheld_journals.h"

#include "engine/io/durable/append_log.h"

#include <algorithm>
#include <functional>

namespace episcope {

namespace fs = std::filesystem;

std::vector<UnheldJournal> unheld_journals(const fs::path& folder) {
  std::vector<UnheldJournal> journals;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const fs::path& path = entry.path();
    if (path.extension() != kJournalSuffix || io::is_held(path)) continue;
    journals.push_back({path, fs::last_write_time(path, error)});
  }
  std::ranges::sort(journals, std::greater{}, &UnheldJournal::last_change);
  return journals;
}

}  // namespace episcope
