// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/broken/broken.h"

#include <sys/stat.h>
#include <fstream>

namespace episcope::test {
namespace in_broken_places {

namespace fs = std::filesystem;

/// A folder full of empty files whose names end so.
fs::path crowd(const fs::path& folder, const std::string& suffix) {
  for (int i = 0; i < 100000; ++i) {
    const std::ofstream file(folder / ("x" + std::to_string(i) + suffix));
  }
  return folder;
}

}  // namespace in_broken_places

std::vector<Broken> broken_places() {
  using namespace in_broken_places;
  return {
      {"link to itself",
       [](const fs::path& f) {
         fs::create_symlink("loop.h5", f / "loop.h5");
         return f / "loop.h5";
       },
       "symbolic links"},
      {"folder with a link to itself as lf.h5",
       [](const fs::path& f) {
         fs::create_symlink("lf.h5", f / "lf.h5");
         return f;
       },
       "no light field in this folder"},
      {"links that go round",
       [](const fs::path& f) {
         fs::create_directory_symlink("b", f / "a");
         fs::create_directory_symlink("a", f / "b");
         return f / "a";
       },
       "symbolic links"},
      {"pipe",
       [](const fs::path& f) {
         ::mkfifo((f / "pipe.h5").c_str(), 0600);
         return f / "pipe.h5";
       },
       "neither a file nor a folder"},
      {"device", [](const fs::path&) { return fs::path("/dev/zero"); },
       "neither a file nor a folder"},
      {"folder named lf.h5",
       [](const fs::path& f) {
         fs::create_directory(f / "lf.h5");
         return f / "lf.h5";
       },
       "the folder is empty"},
      {"folder with a folder named lf.h5",
       [](const fs::path& f) {
         fs::create_directory(f / "lf.h5");
         return f;
       },
       "this is a folder where a file is needed"},
      {"100,000 files of no kind", [](const fs::path& f) { return crowd(f, ".txt"); },
       "no light field in this folder"},
      {"100,000 files that are no pictures", [](const fs::path& f) { return crowd(f, ".png"); },
       ""},
  };
}

}  // namespace episcope::test
