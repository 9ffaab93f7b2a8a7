// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/poses/colmap_binary.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"
#include "engine/io/poses/colmap_pose.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <map>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little);

/// Numbers one after the other; after the end of the file they are 0 and `is_whole` is false.
class BinaryInput {
 public:
  explicit BinaryInput(const fs::path& path)
      : in_(path, std::ios::binary), left_(fs::file_size(path)) {}

  template <class T>
  [[nodiscard]] T next() {
    T value{};
    if (take(sizeof(T))) in_.read(reinterpret_cast<char*>(&value), sizeof(T));
    return value;
  }
  /// Up to a zero.
  [[nodiscard]] std::string next_text() {
    std::string text;
    for (char c = next<char>(); c != '\0'; c = next<char>()) text += c;
    return text;
  }
  void skip(std::uint64_t count, std::uint64_t bytes_each) {
    if (count > left_ / bytes_each) {
      is_whole_ = false;
    } else if (take(count * bytes_each)) {
      in_.ignore(static_cast<std::streamsize>(count * bytes_each));
    }
  }
  [[nodiscard]] bool is_whole() const { return is_whole_ && !in_.fail(); }

 private:
  bool take(std::uint64_t bytes) {
    is_whole_ = is_whole_ && bytes <= left_;
    if (is_whole_) left_ -= bytes;
    return is_whole_;
  }

  std::ifstream in_;
  std::uint64_t left_;
  bool is_whole_ = true;
};

/// By the ids of cameras, up to the first of a model that is not known: of every model the first
/// parameter is a focal length.
std::map<std::uint32_t, double> focal_widths(const fs::path& path) {
  constexpr std::array<std::uint64_t, 12> kParameters{3, 4, 4, 5, 8, 8, 12, 5, 4, 5, 12, 16};
  std::map<std::uint32_t, double> focals;
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return focals;
  BinaryInput in(path);
  const auto count = in.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto id = in.next<std::uint32_t>();
    const auto model = in.next<std::uint32_t>();
    const auto width = static_cast<double>(in.next<std::uint64_t>());
    in.skip(1, sizeof(std::uint64_t));  // height
    const auto focal = in.next<double>();
    if (model >= kParameters.size()) break;
    in.skip(kParameters[model] - 1, sizeof(double));
    if (!in.is_whole()) break;
    if (width > 0) focals[id] = focal / width;
  }
  return focals;
}

}  // namespace

std::vector<CameraPose> read_binary_colmap_poses(const fs::path& path) {
  constexpr std::uint64_t kPoint = 24;  // x, y and an id, of 8 bytes each
  require_readable_file(path);
  if (fs::file_size(path) > kLargestColmap) throw IoError(path, "this file is larger than 1 GB");
  const std::map<std::uint32_t, double> focals = focal_widths(path.parent_path() / "cameras.bin");
  std::vector<CameraPose> poses;
  BinaryInput in(path);
  const auto count = in.next<std::uint64_t>();
  for (std::uint64_t i = 0; i < count && in.is_whole(); ++i) {
    in.skip(1, sizeof(std::uint32_t));  // id of the image
    std::array<double, 7> numbers{};
    for (double& number : numbers) number = in.next<double>();
    CameraPose pose = colmap_pose(numbers);
    const auto focal = focals.find(in.next<std::uint32_t>());
    if (focal != focals.end()) pose.focal_widths = focal->second;
    pose.image = in.next_text();
    in.skip(in.next<std::uint64_t>(), kPoint);
    poses.push_back(std::move(pose));
  }
  if (in.is_whole()) return poses;
  throw IoError(path, fmt::format("it ends within image {} of {}; export it again or remove the "
                                  "file",
                                  poses.size(), count));
}

}  // namespace episcope::io
