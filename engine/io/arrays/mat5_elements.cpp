// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/mat5_elements.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <string>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kHeader = 128;
constexpr std::uint64_t kTag = 8;
constexpr std::uint32_t kMatrix = 14;
constexpr std::uint32_t kCompressed = 15;
constexpr std::uint64_t kBeginning = 4096;  ///< Of a compressed variable: dimensions and name.
constexpr int kHeadOfMatrix = 3;            ///< Elements: flags, dimensions, name.
constexpr int kDeepest = 32;                ///< The library calls itself for each.

std::uint32_t number_at(const std::string& bytes, std::size_t at, bool is_little) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    number = number << 8 | static_cast<unsigned char>(bytes[at + (is_little ? 3 - i : i)]);
  }
  return number;
}

struct Element {
  std::uint32_t type = 0;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
  std::uint64_t next = 0;
};

/// Elements of a file or of a part that was unpacked.
class Elements {
 public:
  using Read = std::function<std::string(std::uint64_t at, std::uint64_t count)>;
  Elements(const fs::path& path, bool is_little, Read read)
      : path_(path), is_little_(is_little), read_(std::move(read)) {}

  [[nodiscard]] IoError damaged() const { return damaged_mat5(path_); }

  /// That at `at`, which must end before `end`.
  [[nodiscard]] Element at(std::uint64_t at, std::uint64_t end) const {
    if (end - at < kTag) throw damaged();
    const std::string tag = read_(at, kTag);
    if (tag.size() != kTag) throw damaged();
    const std::uint32_t first = number_at(tag, 0, is_little_);
    Element element{first, at + kTag, 0, 0};
    std::uint64_t bytes = number_at(tag, 4, is_little_);
    if (first >> 16 != 0) {  // four bytes at most, within the tag
      element.type = first & 0xFFFF;
      element.begin = at + 4;
      bytes = first >> 16;
    }
    if (bytes > end - element.begin) throw damaged();
    element.end = element.begin + bytes;
    element.next = first >> 16 != 0 ? at + kTag : element.end + (kTag - bytes % kTag) % kTag;
    return element;
  }

  /// All of a matrix, and of those in it.
  void check(std::uint64_t begin, std::uint64_t end, int depth) const {
    if (depth == kDeepest) throw damaged();
    for (std::uint64_t place = begin; place < end;) {
      const Element element = at(place, end);
      if (element.type == kMatrix) check(element.begin, element.end, depth + 1);
      place = element.next;
    }
  }

 private:
  const fs::path& path_;
  bool is_little_;
  Read read_;
};

std::string inflated(std::string packed) {
  std::string out(kBeginning, '\0');
  z_stream state{};
  if (inflateInit(&state) != Z_OK) return {};
  state.next_in = reinterpret_cast<Bytef*>(packed.data());
  state.avail_in = static_cast<uInt>(packed.size());
  state.next_out = reinterpret_cast<Bytef*>(out.data());
  state.avail_out = static_cast<uInt>(out.size());
  inflate(&state, Z_SYNC_FLUSH);
  out.resize(out.size() - state.avail_out);
  inflateEnd(&state);
  return out;
}

/// The beginning of a compressed variable: its dimensions and its name must be there as a whole.
void check_compressed(const fs::path& path, bool is_little, const std::string& packed) {
  const std::string bytes = inflated(packed);
  const Elements unpacked(path, is_little, [&](std::uint64_t at, std::uint64_t count) {
    return at > bytes.size() ? std::string() : bytes.substr(at, count);
  });
  if (bytes.size() < kTag || number_at(bytes, 0, is_little) != kMatrix) throw unpacked.damaged();
  std::uint64_t place = kTag;
  for (int i = 0; i < kHeadOfMatrix; ++i) place = unpacked.at(place, bytes.size()).next;
}

}  // namespace

IoError damaged_mat5(const fs::path& path) {
  return {path, "the MATLAB file is truncated or damaged; copy or save it again"};
}

void require_sound_elements(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  const auto read = [&in](std::uint64_t at, std::uint64_t count) {
    std::string bytes(count, '\0');
    in.clear();
    in.seekg(static_cast<std::streamoff>(at))
        .read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    return bytes;
  };
  const bool is_little = read(126, 1) == "I";
  const Elements elements(path, is_little, read);
  const std::uint64_t size = fs::file_size(path);
  for (std::uint64_t place = kHeader; place < size;) {
    const Element element = elements.at(place, size);
    const std::uint64_t bytes = element.end - element.begin;
    if (element.type == kMatrix) elements.check(element.begin, element.end, 0);
    if (element.type == kCompressed) {
      check_compressed(path, is_little, read(element.begin, std::min(bytes, kBeginning)));
    }
    place = element.end;  // not padded here
  }
}

}  // namespace episcope::io
