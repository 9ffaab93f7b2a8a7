// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fuzz/harness.h"

#include "engine/core/hash.h"

#include <hdf5.h>
#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stop_token>

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

constexpr std::uint64_t kWholeOneOf = 64;
bool is_whole = true;

const Folder& folder() {
  static const Folder folder;
  return folder;
}

/// Before each.
void begin_input(std::string_view bytes) {
  Fnv1a hash;
  hash.add(bytes);
  is_whole = hash.value() % kWholeOneOf == 0;
}

}  // namespace

void write_bytes(const fs::path& path, std::string_view bytes) {
  std::ofstream out(path, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

bool is_read_whole() {
  return is_whole;
}

Progress progress_of_reading() {
  if (is_whole) return Progress(1);
  std::stop_source stop;
  const auto listen = [stop](const ProgressState& state) mutable {
    const bool is_looking = state.step == "checking the order of views" ||
                            state.step == "arranging the views of the list";
    if (is_looking) stop.request_stop();
  };
  return {stop.get_token(), listen, 1};
}

}  // namespace episcope::fuzz

/// `--seeds=FOLDER` writes the seeds and ends.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr const char* option = "--seeds=";
  if (*argc == 2 && std::strncmp((*argv)[1], option, std::strlen(option)) == 0) {
    episcope::fuzz::kHarness.write_seeds((*argv)[1] + std::strlen(option));
    std::_Exit(0);
  }
  // HDF5 takes half a megabyte for every file that it opens, and gives it back.
  H5set_free_list_limits(-1, -1, -1, -1, -1, -1);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace episcope::fuzz;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::filesystem::path file = folder().path() / kHarness.name_of(bytes);
  write_bytes(file, bytes);
  begin_input(bytes);
  tolerate([&] { kHarness.read(file); });
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
  return 0;
}
