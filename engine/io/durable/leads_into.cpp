// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/leads_into.h"

#include <algorithm>

namespace episcope::io {

namespace fs = std::filesystem;

bool leads_into(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const fs::path root = error ? fs::path() : fs::weakly_canonical(here / folder, error);
  const fs::path place = error ? fs::path() : fs::weakly_canonical(here / path, error);
  return !error && std::ranges::mismatch(root, place).in1 == root.end();
}

}  // namespace episcope::io
