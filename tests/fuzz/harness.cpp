// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/harness.h"

#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace episcope::fuzz {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the program.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "episcope_fuzz_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      std::perror("no temporary folder");
      std::abort();
    }
    path_ = name;
    if (kHarness.prepare) kHarness.prepare(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

const Folder& folder() {
  static const Folder folder;
  return folder;
}

}  // namespace

void write_bytes(const fs::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace episcope::fuzz

/// `--seeds=FOLDER` writes the seeds and ends.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* option = "--seeds=";
  if (*argc == 2 && std::strncmp((*argv)[1], option, std::strlen(option)) == 0) {
    episcope::fuzz::kHarness.write_seeds((*argv)[1] + std::strlen(option));
    std::_Exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace episcope::fuzz;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = folder().path() / kHarness.name_of(bytes);
  write_bytes(file, bytes);
  tolerate([&] { kHarness.read(file); });
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return 0;
}
