// SPDX-License-Identifier: BSD-3-Clause
#include "tests/app/kills/saved_files.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace episcope::test {

namespace fs = std::filesystem;

Contents contents_of(const fs::path& folder, Unfinished unfinished) {
  Contents contents;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::end(it); ++it) {
    const bool is_hidden = it->path().filename().string().starts_with(".");
    if (is_hidden && unfinished == Unfinished::IsLeftOut) {
      it.disable_recursion_pending();
      continue;
    }
    if (!it->is_regular_file()) continue;
    std::ifstream in(it->path(), std::ios::binary);
    contents[it->path().lexically_relative(folder)] = {std::istreambuf_iterator<char>(in), {}};
  }
  return contents;
}

Saver saver_named(const std::string& name) {
  for (Saver& saver : savers()) {
    if (saver.name == name) return std::move(saver);
  }
  throw std::runtime_error("nothing is saved by the name of " + name);
}

fs::path empty_folder(const fs::path& folder) {
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

}  // namespace episcope::test
