// SPDX-License-Identifier: BSD-3-Clause
// In place of libFuzzer, for memcheck, which sees into libraries that no sanitizer was built into:
// NAME_fuzz INPUTS LAST FILES… reads the files and INPUTS mutants of them, the same ones in every
// run. The file LAST holds the input that is being read.
#include "tests/fuzz/harness.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace episcope::fuzz {
namespace {

constexpr std::size_t kLongest = 16384;

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> files) : files_(std::move(files)) {}

  std::string mutant() {
    constexpr std::array<int, 5> kSteps{1, 1, 2, 3, 5};
    std::string bytes = any_file();
    for (int left = kSteps[below(kSteps.size())]; left > 0 && !bytes.empty(); --left) change(bytes);
    bytes.resize(std::min(bytes.size(), kLongest));
    return bytes;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  const std::string& any_file() { return files_[below(files_.size())]; }

  void change(std::string& bytes) {
    constexpr std::size_t kLongestPart = 60;
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(random_());
        break;
      case 1:
        set_number(bytes, at);
        break;
      case 2:
        bytes.insert(at, bytes.substr(at, 1 + below(kLongestPart)));
        break;
      case 3:
        bytes.erase(at, 1 + below(kLongestPart));
        break;
      case 4:
        bytes.insert(at, part_of_any());
        break;
      default:
        bytes.replace(at, std::string::npos, part_of_any());
    }
  }

  /// What counts and lengths are compared with.
  void set_number(std::string& bytes, std::size_t at) {
    const std::array<std::uint64_t, 5> numbers{0, ~0ULL, ~0ULL >> 1, random_(), below(300)};
    const std::size_t width = std::size_t{1} << below(4);
    std::uint64_t number = numbers[below(numbers.size())];
    std::string written;
    for (std::size_t i = 0; i < width; ++i, number >>= 8) written += static_cast<char>(number);
    if (below(2) == 0) std::ranges::reverse(written);
    bytes.replace(at, width, written);
  }

  std::string part_of_any() {
    const std::string& other = any_file();
    return other.empty() ? other : other.substr(below(other.size()), below(kLongest));
  }

  std::vector<std::string> files_;
  std::mt19937_64 random_{1};
};

void read_input(const char* last, const std::string& bytes) {
  write_bytes(last, bytes);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

int replay(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s INPUTS LAST FILES…, or --seeds=FOLDER\n", argv[0]);
    return 2;
  }
  std::vector<std::string> files;
  for (int i = 3; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    read_input(argv[2], files.back());
  }
  Mutator mutator(std::move(files));
  for (long left = std::atol(argv[1]); left > 0; --left) read_input(argv[2], mutator.mutant());
  return 0;
}

}  // namespace
}  // namespace episcope::fuzz

int main(int argc, char** argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  return episcope::fuzz::replay(argc, argv);
}
