// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/npy.h"
#include "engine/io/models/poses.h"
#include "tests/fuzz/harness.h"

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

namespace episcope::fuzz {
namespace {

constexpr int kSide = 3;

std::string image_name(int i) {
  return fmt::format("{}.png", i);
}

std::string nerf_poses() {
  std::string text = R"({"camera_angle_x": 0.8, "frames": [)";
  for (int i = 0; i < kSide * kSide; ++i) {
    text += fmt::format(R"({}{{"file_path": "./{}", "transform_matrix": [)", i > 0 ? ", " : "", i) +
            fmt::format("[1, 0, 0, {}], [0, 1, 0, {}], [0, 0, 1, 0], [0, 0, 0, 1]]}}", i % kSide,
                        -i / kSide);
  }
  return text + "]}";
}

std::string colmap_poses() {
  std::string text = "# images\n";
  for (int i = 0; i < kSide * kSide; ++i) {
    text += fmt::format("{} 1 0 0 0 {} {} 0 1 {}\n\n", i, -i % kSide, -i / kSide, image_name(i));
  }
  return text;
}

template <class T>
void append(std::string& bytes, T number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
}

std::string binary_colmap_poses() {
  std::string bytes;
  append(bytes, std::uint64_t{kSide * kSide});
  for (int i = 0; i < kSide * kSide; ++i) {
    append(bytes, static_cast<std::uint32_t>(i));
    for (const double number : {1.0, 0.0, 0.0, 0.0, -1.0 * (i % kSide), -1.0 * (i / kSide), 0.0}) {
      append(bytes, number);
    }
    append(bytes, std::uint32_t{1});
    bytes += image_name(i) + '\0';
    append(bytes, std::uint64_t{i % 2 == 0 ? 1U : 0U});
    if (i % 2 == 0) bytes.append(24, '\1');
  }
  return bytes;
}

void write_seeds(const std::filesystem::path& folder) {
  std::vector<float> numbers;
  for (int i = 0; i < kSide * kSide; ++i) {
    const auto x = static_cast<float>(i % kSide), y = static_cast<float>(i / kSide);
    // Rows of the matrix: down, right, backwards, the place; then the size and bounds.
    for (const float value :
         {0.F, 1.F, 0.F, x, 60.F, 1.F, 0.F, 0.F, y, 72.F, 0.F, 0.F, -1.F, 0.F, 90.F, 1.F, 9.F}) {
      numbers.push_back(value);
    }
  }
  io::write_npy<float>(folder / "poses.npy", {kSide * kSide, 17}, numbers);
  write_bytes(folder / "transforms", nerf_poses());
  write_bytes(folder / "images", colmap_poses());
  write_bytes(folder / "binary", binary_colmap_poses());
}

std::string name_of(std::string_view bytes) {
  return bytes.starts_with("\x93NUMPY") ? "poses_bounds.npy"
         : bytes.starts_with('{')       ? "transforms.json"
         : bytes.starts_with('\x09')    ? "images.bin"
                                        : "images.txt";
}

/// Poses of nine cameras, in each of the forms.
void read(const std::filesystem::path& file) {
  std::vector<std::filesystem::path> images;
  for (int i = 0; i < kSide * kSide; ++i) images.emplace_back(image_name(i));
  for (const auto& found : io::find_poses(file.parent_path(), file.parent_path(), images)) {
    if (found.problem.empty()) (void)io::find_pose_grid(found.poses);
  }
}

}  // namespace

const Harness kHarness{name_of, read, write_seeds};

}  // namespace episcope::fuzz
