// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/sequence_reader.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/names/view_names.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_scene.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

namespace episcope::fuzz {
namespace {

constexpr std::size_t kMostNames = 40;
constexpr std::size_t kLongestName = 100;

void write_seeds(const std::filesystem::path& folder) {
  write_bytes(folder / "grid", "{row}_{col}.png\n0_0.png\n0_1.png\n1_0.png\n1_1.png\n");
  write_bytes(folder / "stanford",
              "out_{row}_{col}_*.png\nout_00_00_-381.9_812.5_.png\nout_00_01_-382.9_813.5_.png\n");
  write_bytes(folder / "frames", "*\nframe_000.h5\nframe_001.h5\nframe_002.h5\n");
  write_bytes(folder / "list", "a{index}b\nview (1).png\nview (2).png\nview (3).png\nparam.txt\n");
  write_bytes(folder / "rows", "*\nrow_0/0.png\nrow_0/1.png\nrow_1/0.png\nrow_1/1.png\n");
  write_bytes(folder / "signed", "*\nv_-1_-1.png\nv_-1_0.png\nv_0_-1.png\nv_0_0.png\n");
  write_bytes(folder / "inner",
              "*\nviews/1_1.png\nviews/1_2.png\nviews/2_1.png\nviews/2_2.png\n"
              "note.txt\n");
  write_bytes(folder / "benchmark",
              "*\ninput_Cam001.png\ninput_Cam002.png\ninput_Cam003.png\n"
              "input_Cam004.png\n");
}

bool is_name(const std::string& text) {
  return !text.empty() && text != "." && text != ".." && text.find('/') == std::string::npos &&
         text.find('\0') == std::string::npos;
}

/// In the folder, or in one that is in it: `row_1/2.png`.
void add_picture(const std::filesystem::path& folder, const std::string& name) {
  const std::size_t slash = std::min(name.find('/'), name.size());
  const std::string first = name.substr(0, slash);
  if (!is_name(first)) return;
  std::filesystem::path file = folder / first;
  if (slash < name.size()) {
    if (!is_name(name.substr(slash + 1))) return;
    std::error_code ignored;
    std::filesystem::create_directory(file, ignored);
    file /= name.substr(slash + 1);
  }
  std::ofstream(file) << "P5 2 2 255 abcd";
}

/// What the names alone say.
void place_names(const std::vector<std::string>& names, const std::string& pattern) {
  const std::vector<std::filesystem::path> images(names.begin(), names.end());
  tolerate([&] {
    const io::ViewNames matches = io::match_view_names(images, pattern);
    if (matches.views.size() > 1) (void)io::place_views({}, matches);
  });
  tolerate([&] { (void)io::place_views({}, io::find_view_names({}, images)); });
}

/// Files of these names.
void read_folder(const std::filesystem::path& folder, const std::vector<std::string>& names,
                 const std::string& pattern) {
  std::filesystem::remove_all(folder);
  std::filesystem::create_directory(folder);
  for (const std::string& name : names) add_picture(folder, name);
  (void)io::numbered_frames(folder);
  tolerate([&] { (void)io::preview_pattern(folder, pattern, true); });
  open_light_field(folder);
}

/// Names of files, a line each; the first line is a pattern that a user writes.
void read(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string pattern;
  std::getline(in, pattern);
  std::vector<std::string> names;
  for (std::string name; names.size() < kMostNames && std::getline(in, name);) {
    if (name.size() <= kLongestName) names.push_back(name);
  }
  place_names(names, pattern);
  if (is_read_whole()) read_folder(file.parent_path() / "names", names, pattern);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("list"); }, read, write_seeds};

}  // namespace episcope::fuzz
