// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/zip_file.h"

#include "engine/core/error.h"
#include "engine/io/durable/system_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <string_view>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kLocal = 0x04034B50;
constexpr std::uint32_t kCentral = 0x02014B50;
constexpr std::uint32_t kEnd64 = 0x06064B50;
constexpr std::uint32_t kLocator64 = 0x07064B50;
constexpr std::uint64_t kLongestComment = 65535;
constexpr std::uint64_t kEndLength = 22;
constexpr std::uint64_t kLocatorLength = 20;
constexpr std::uint64_t kLargestDirectory = std::uint64_t{64} << 20;
constexpr std::uint32_t kIn64 = 0xFFFFFFFF;

IoError damaged(const fs::path& path) {
  return {path, "the zip archive is truncated or damaged; copy or save it again"};
}

/// Little-endian numbers out of a part of the archive.
class Bytes {
 public:
  Bytes(const fs::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

  template <class T>
  [[nodiscard]] T number(std::size_t at) const {
    T value = 0;
    const std::string_view held = part(at, sizeof(T));
    for (std::size_t i = sizeof(T); i-- > 0;) {
      value = static_cast<T>(std::uint64_t{value} << 8 | static_cast<unsigned char>(held[i]));
    }
    return value;
  }
  [[nodiscard]] std::string_view part(std::size_t at, std::size_t length) const {
    if (at > bytes_.size() || length > bytes_.size() - at) throw damaged(path_);
    return bytes_.substr(at, length);
  }

 private:
  const fs::path& path_;
  std::string_view bytes_;
};

std::string read_part(std::ifstream& in, const fs::path& path, std::uint64_t at,
                      std::uint64_t length) {
  std::string bytes(length, '\0');
  in.clear();
  if (!in.seekg(static_cast<std::streamoff>(at))
           .read(bytes.data(), static_cast<std::streamsize>(length))) {
    throw damaged(path);
  }
  return bytes;
}

struct Directory {
  std::uint64_t begin = 0;
  std::uint64_t bytes = 0;
};

Directory find_directory(std::ifstream& in, const fs::path& path, std::uint64_t size) {
  const std::uint64_t tail = std::min(size, kLongestComment + kEndLength + kLocatorLength);
  const std::string end = read_part(in, path, size - tail, tail);
  const std::size_t at = end.rfind(std::string_view("PK\5\6", 4));
  if (at == std::string::npos || end.size() - at < kEndLength) throw damaged(path);
  const Bytes bytes(path, end);
  Directory found{bytes.number<std::uint32_t>(at + 16), bytes.number<std::uint32_t>(at + 12)};
  const bool has_64 =
      at >= kLocatorLength && bytes.number<std::uint32_t>(at - kLocatorLength) == kLocator64;
  if (has_64) {
    const auto place = bytes.number<std::uint64_t>(at - kLocatorLength + 8);
    if (place > size || size - place < 56) throw damaged(path);
    const std::string end64 = read_part(in, path, place, 56);
    const Bytes large(path, end64);
    if (large.number<std::uint32_t>(0) != kEnd64) throw damaged(path);
    found = {large.number<std::uint64_t>(48), large.number<std::uint64_t>(40)};
  }
  if (found.begin > size || found.bytes > size - found.begin || found.bytes > kLargestDirectory) {
    throw damaged(path);
  }
  return found;
}

/// Sizes beyond 32 bits lie in an extra field.
void read_sizes_64(const Bytes& extra, std::size_t length, ZipEntry& entry, std::uint64_t& header) {
  for (std::size_t at = 0; at + 4 <= length;) {
    const auto id = extra.number<std::uint16_t>(at);
    const auto bytes = extra.number<std::uint16_t>(at + 2);
    std::size_t next = at + 4;
    if (id == 1) {
      for (std::uint64_t* value : {&entry.size, &entry.stored, &header}) {
        if (*value != kIn64 || next + 8 > at + 4 + bytes) continue;
        *value = extra.number<std::uint64_t>(next);
        next += 8;
      }
    }
    at += 4U + bytes;
  }
}

/// Reads the entry at `at` of the directory and moves on.
ZipEntry read_entry(std::ifstream& in, const fs::path& path, const Bytes& directory,
                    std::size_t& at, std::uint64_t size) {
  if (directory.number<std::uint32_t>(at) != kCentral) throw damaged(path);
  const auto flags = directory.number<std::uint16_t>(at + 8);
  const auto method = directory.number<std::uint16_t>(at + 10);
  const auto name = directory.number<std::uint16_t>(at + 28);
  const auto extra = directory.number<std::uint16_t>(at + 30);
  const auto comment = directory.number<std::uint16_t>(at + 32);
  ZipEntry entry{std::string(directory.part(at + 46, name)), 0,
                 directory.number<std::uint32_t>(at + 20), directory.number<std::uint32_t>(at + 24),
                 method == 8};
  std::uint64_t header = directory.number<std::uint32_t>(at + 42);
  const std::string_view fields = directory.part(at + 46 + name, extra);
  read_sizes_64(Bytes(path, fields), fields.size(), entry, header);
  at += 46U + name + extra + comment;
  if ((flags & 1) != 0 || (method != 0 && method != 8)) {
    throw IoError(path, fmt::format("{} in the zip archive is {}; save it with numpy.savez",
                                    entry.name.substr(0, 80),
                                    (flags & 1) != 0 ? "encrypted"
                                                     : "compressed by another method "
                                                       "than deflate"));
  }
  if (header > size || size - header < 30) throw damaged(path);
  const std::string local = read_part(in, path, header, 30);
  const Bytes begin(path, local);
  if (begin.number<std::uint32_t>(0) != kLocal) throw damaged(path);
  entry.begin = header + 30 + begin.number<std::uint16_t>(26) + begin.number<std::uint16_t>(28);
  if (entry.begin > size || entry.stored > size - entry.begin) throw damaged(path);
  return entry;
}

}  // namespace

bool has_zip_signature(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  char begin[4] = {};
  if (!in.read(begin, sizeof begin)) return false;
  const std::string_view signature(begin, sizeof begin);
  return signature == std::string_view("PK\3\4", 4) || signature == std::string_view("PK\5\6", 4);
}

std::vector<ZipEntry> list_zip(const fs::path& path) {
  require_readable_file(path);
  std::ifstream in(path, std::ios::binary);
  const std::uint64_t size = fs::file_size(path);
  const Directory place = find_directory(in, path, size);
  const std::string bytes = read_part(in, path, place.begin, place.bytes);
  const Bytes directory(path, bytes);
  std::vector<ZipEntry> entries;
  for (std::size_t at = 0; at + 46 <= bytes.size();) {
    entries.push_back(read_entry(in, path, directory, at, size));
  }
  return entries;
}

}  // namespace episcope::io
