// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/reader.h"

#include <algorithm>

namespace episcope::io {

namespace fs = std::filesystem;

bool Reader::has_option(std::string_view key) const {
  const bool is_of_all = key == "equalize" || key == "no-equalize";  // assemble_scene.h
  return is_of_all || std::ranges::find(options, key) != options.end();
}

FoundReader find_reader(const fs::path& path, const OpenOptions& options) {
  if (!fs::is_directory(path)) {
    require_readable_file(path);
    if (fs::file_size(path) == 0) throw IoError(path, kEmptyFile);
  }
  for (const Reader& reader : readers()) {
    if (fs::path found = reader.find(path, options); !found.empty()) {
      return {&reader, std::move(found)};
    }
  }
  return {};
}

const Reader* reader_named(const std::string& id) {
  const auto all = readers();
  const auto found = std::ranges::find(all, id, &Reader::id);
  return found == all.end() ? nullptr : &*found;
}

}  // namespace episcope::io
