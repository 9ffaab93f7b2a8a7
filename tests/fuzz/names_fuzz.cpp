// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/pattern_preview.h"
#include "engine/io/sequence/frame_names.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <fstream>
#include <sstream>

namespace episcope::fuzz {
namespace {

constexpr int kMostNames = 40;
constexpr std::size_t kLongestName = 100;

void write_seeds(const std::filesystem::path& folder) {
  write_bytes(folder / "grid", "{row}_{col}.png\n0_0.png\n0_1.png\n1_0.png\n1_1.png\n");
  write_bytes(folder / "stanford",
              "out_{row}_{col}_*.png\nout_00_00_-381.9_812.5_.png\nout_00_01_-382.9_813.5_.png\n");
  write_bytes(folder / "frames", "*\nframe_000.h5\nframe_001.h5\nframe_002.h5\n");
  write_bytes(folder / "list", "a{index}b\nview (1).png\nview (2).png\nview (3).png\nparam.txt\n");
}

/// Names of files, a line each; the first line is a pattern that a user writes.
void read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string pattern;
  std::getline(in, pattern);
  const std::filesystem::path folder = file.parent_path() / "names";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  std::string name;
  for (int i = 0; i < kMostNames && std::getline(in, name); ++i) {
    const bool is_name = !name.empty() && name.size() <= kLongestName && name != "." &&
                         name != ".." && name.find('/') == std::string::npos &&
                         name.find('\0') == std::string::npos;
    if (is_name) std::ofstream(folder / name) << "P5 2 2 255 abcd";
  }
  (void)io::numbered_frames(folder);
  tolerate([&] { (void)io::preview_pattern(folder, pattern, true); });
  open_light_field(folder);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("list"); }, read, write_seeds};

}  // namespace episcope::fuzz
