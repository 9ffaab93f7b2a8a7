// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/mat5_elements.h"

#include "engine/io/arrays/inflate_stream.h"

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
constexpr int kHeadOfMatrix = 3;      ///< Elements: flags, dimensions, name.
constexpr std::uint32_t kStruct = 3;  ///< Kinds of matrices up to this hold others.
constexpr std::uint32_t kFirstNumeric = 6, kLastNumeric = 15;
constexpr std::uint64_t kWhollyChecked = 64 << 20;  ///< Bytes of a variable, unpacked.
constexpr int kDeepest = 32;                        ///< The library calls itself for each.

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

/// The dimensions and the name of a compressed variable must be there as a whole; of one that holds
/// others, all of it; of samples that are not large, they too.
void check_compressed(const fs::path& path, bool is_little, const Element& packed) {
  InflateStream stream(path, packed.begin, packed.end - packed.begin);
  const auto read = [&stream](std::uint64_t at, std::uint64_t count) {
    std::string bytes(count, '\0');
    if (!stream.skip_to(at)) return std::string();
    bytes.resize(stream.read(count, reinterpret_cast<std::uint8_t*>(bytes.data())));
    return bytes;
  };
  const Elements elements(path, is_little, read);
  const std::string tag = read(0, kTag);
  if (tag.size() != kTag || number_at(tag, 0, is_little) != kMatrix) throw elements.damaged();
  const std::uint64_t end = kTag + number_at(tag, 4, is_little);
  const Element flags = elements.at(kTag, end);
  const std::string kind = read(flags.begin, 4);
  if (kind.size() != 4) throw elements.damaged();
  const std::uint32_t kind_number = number_at(kind, 0, is_little) & 0xFF;
  if (kind_number <= kStruct) return elements.check(flags.next, end, 1);
  std::uint64_t place = flags.next;
  for (int i = 1; i < kHeadOfMatrix; ++i) place = elements.at(place, end).next;
  const bool is_numeric = kind_number >= kFirstNumeric && kind_number <= kLastNumeric;
  if (!is_numeric || end > kWhollyChecked || place == end) return;
  // `end` may be too far: matio adds to it.
  const bool is_there = stream.skip_to(elements.at(place, end).end);
  if (!is_there || !stream.ends_well()) throw elements.damaged();
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
    if (element.type == kMatrix) elements.check(element.begin, element.end, 0);
    if (element.type == kCompressed) check_compressed(path, is_little, element);
    place = element.end;  // not padded here
  }
}

}  // namespace episcope::io
