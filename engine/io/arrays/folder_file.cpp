// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/folder_file.h"

#include "engine/io/grid/decode_image.h"

namespace episcope::io {

namespace fs = std::filesystem;

fs::path only_file_in(const fs::path& folder,
                      const std::function<bool(const fs::path&)>& is_meant) {
  fs::path found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_image_name(entry.path())) return {};
    if (!is_meant(entry.path())) continue;
    if (!found.empty()) return {};
    found = entry.path();
  }
  return found;
}

}  // namespace episcope::io
