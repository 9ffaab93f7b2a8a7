// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/base/zip.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <algorithm>
#include <new>
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
class ZipBytes {
 public:
  ZipBytes(const fs::path& path, std::string_view bytes) : path_(path), bytes_(bytes) {}

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
  const ZipBytes bytes(path, end);
  Directory found{bytes.number<std::uint32_t>(at + 16), bytes.number<std::uint32_t>(at + 12)};
  const bool has_64 =
      at >= kLocatorLength && bytes.number<std::uint32_t>(at - kLocatorLength) == kLocator64;
  if (has_64) {
    const auto place = bytes.number<std::uint64_t>(at - kLocatorLength + 8);
    if (place > size || size - place < 56) throw damaged(path);
    const std::string end64 = read_part(in, path, place, 56);
    const ZipBytes large(path, end64);
    if (large.number<std::uint32_t>(0) != kEnd64) throw damaged(path);
    found = {large.number<std::uint64_t>(48), large.number<std::uint64_t>(40)};
  }
  if (found.begin > size || found.bytes > size - found.begin || found.bytes > kLargestDirectory) {
    throw damaged(path);
  }
  return found;
}

/// Sizes beyond 32 bits lie in an extra field.
void read_sizes_64(const ZipBytes& extra, std::size_t length, ZipEntry& entry,
                   std::uint64_t& header) {
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
ZipEntry read_entry(std::ifstream& in, const fs::path& path, const ZipBytes& directory,
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
  read_sizes_64(ZipBytes(path, fields), fields.size(), entry, header);
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
  const ZipBytes begin(path, local);
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
  const ZipBytes directory(path, bytes);
  std::vector<ZipEntry> entries;
  for (std::size_t at = 0; at + 46 <= bytes.size();) {
    entries.push_back(read_entry(in, path, directory, at, size));
  }
  return entries;
}

namespace {

constexpr std::uint64_t kMostIn16 = 0xFFFF;
constexpr std::uint16_t kZip64Version = 45;
constexpr std::uint16_t kZipVersion = 20;
/// 1 January 1980: files of equal contents are equal.
constexpr std::uint32_t kDate = 0x00210000;

/// Numbers in little-endian order.
class Record {
 public:
  template <class T>
  Record& add(T number) {
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(number) >> (8 * i)));
    }
    return *this;
  }
  Record& add(const std::string& text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::vector<std::uint8_t> bytes_;
};

std::uint32_t in_32(std::uint64_t value) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(value, kIn64));
}

}  // namespace

ZipWriter::ZipWriter(const AtomicFile& file)
    : path_(file.target()), file_(file.temporary(), O_WRONLY | O_TRUNC) {
  if (!file_.ok()) throw write_error(path_);
}

void ZipWriter::write(std::span<const std::uint8_t> bytes) {
  if (!write_all(file_.id(), bytes)) throw write_error(path_);
  position_ += bytes.size();
}

void ZipWriter::add(const std::string& name,
                    const std::vector<std::span<const std::uint8_t>>& parts) {
  Entry entry{name, 0, 0, position_};
  for (const auto& part : parts) {
    entry.checksum = static_cast<std::uint32_t>(crc32_z(entry.checksum, part.data(), part.size()));
    entry.size += part.size();
  }
  const bool is_large = entry.size >= kIn64;
  Record header;
  header.add(std::uint32_t{0x04034B50}).add(is_large ? kZip64Version : kZipVersion);
  header.add(std::uint16_t{0}).add(std::uint16_t{0}).add(kDate).add(entry.checksum);
  header.add(in_32(entry.size)).add(in_32(entry.size));
  header.add(static_cast<std::uint16_t>(name.size()));
  header.add(static_cast<std::uint16_t>(is_large ? 20 : 0)).add(name);
  if (is_large) {
    header.add(std::uint16_t{1}).add(std::uint16_t{16}).add(entry.size).add(entry.size);
  }
  write(header.bytes());
  for (const auto& part : parts) write(part);
  entries_.push_back(std::move(entry));
}

void ZipWriter::close() {
  const std::uint64_t begin = position_;
  for (const Entry& entry : entries_) {
    const bool is_large = entry.size >= kIn64 || entry.begin >= kIn64;
    Record record;
    record.add(std::uint32_t{0x02014B50})
        .add(kZip64Version)
        .add(is_large ? kZip64Version : kZipVersion);
    record.add(std::uint16_t{0}).add(std::uint16_t{0}).add(kDate).add(entry.checksum);
    const std::uint64_t size = is_large ? kIn64 : entry.size;
    record.add(in_32(size)).add(in_32(size)).add(static_cast<std::uint16_t>(entry.name.size()));
    record.add(static_cast<std::uint16_t>(is_large ? 28 : 0)).add(std::uint16_t{0});
    record.add(std::uint16_t{0}).add(std::uint16_t{0}).add(std::uint32_t{0});
    record.add(in_32(is_large ? kIn64 : entry.begin)).add(entry.name);
    if (is_large) {
      record.add(std::uint16_t{1}).add(std::uint16_t{24});
      record.add(entry.size).add(entry.size).add(entry.begin);
    }
    write(record.bytes());
  }
  const std::uint64_t bytes = position_ - begin;
  const std::uint64_t count = entries_.size();
  Record end;
  if (begin >= kIn64) {
    end.add(std::uint32_t{0x06064B50}).add(std::uint64_t{44}).add(kZip64Version).add(kZip64Version);
    end.add(std::uint32_t{0}).add(std::uint32_t{0}).add(count).add(count).add(bytes).add(begin);
    end.add(std::uint32_t{0x07064B50}).add(std::uint32_t{0}).add(position_).add(std::uint32_t{1});
  }
  const auto short_count = static_cast<std::uint16_t>(std::min(count, kMostIn16));
  end.add(std::uint32_t{0x06054B50}).add(std::uint16_t{0}).add(std::uint16_t{0});
  end.add(short_count).add(short_count).add(in_32(bytes)).add(in_32(begin)).add(std::uint16_t{0});
  write(end.bytes());
  file_ = FileDescriptor();
}

namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr std::size_t kMostAtOnce = std::size_t{1} << 30;
constexpr int kRawDeflate = -MAX_WBITS;

}  // namespace

InflateStream::InflateStream(const std::filesystem::path& path, const ZipEntry& entry)
    : InflateStream(path, entry.begin, entry.stored, kRawDeflate) {}

InflateStream::InflateStream(const std::filesystem::path& path, std::uint64_t begin,
                             std::uint64_t bytes)
    : InflateStream(path, begin, bytes, MAX_WBITS) {}

InflateStream::InflateStream(const std::filesystem::path& path, std::uint64_t begin,
                             std::uint64_t bytes, int window)
    : in_(path, std::ios::binary), left_(bytes), piece_(kPiece) {
  in_.seekg(static_cast<std::streamoff>(begin));
  if (inflateInit2(&state_, window) != Z_OK) throw std::bad_alloc();
}

InflateStream::~InflateStream() {
  inflateEnd(&state_);
}

std::size_t InflateStream::read(std::size_t bytes, std::uint8_t* out) {
  std::size_t done = 0;
  while (done < bytes) {
    // Without input the last bytes may still be to come.
    const bool has_input = state_.avail_in > 0 || refill();
    const std::size_t wanted = std::min(bytes - done, kMostAtOnce);
    state_.next_out = out + done;
    state_.avail_out = static_cast<uInt>(wanted);
    const int result = inflate(&state_, Z_NO_FLUSH);
    const std::size_t got = wanted - state_.avail_out;
    done += got;
    is_damaged_ = is_damaged_ || result == Z_DATA_ERROR;
    const bool is_over = result != Z_OK && result != Z_BUF_ERROR;
    if (is_over || (!has_input && got == 0)) break;
  }
  position_ += done;
  return done;
}

bool InflateStream::skip_to(std::uint64_t position) {
  std::vector<std::uint8_t> skipped(std::min<std::uint64_t>(position - position_, kPiece));
  while (position_ < position) {
    const std::size_t step = std::min<std::uint64_t>(position - position_, skipped.size());
    if (read(step, skipped.data()) != step) return false;
  }
  return true;
}

bool InflateStream::ends_well() {
  std::vector<std::uint8_t> rest(kPiece);
  read(rest.size(), rest.data());
  return !is_damaged_;
}

bool InflateStream::refill() {
  const std::size_t wanted = std::min<std::uint64_t>(left_, piece_.size());
  if (wanted == 0) return false;
  in_.read(reinterpret_cast<char*>(piece_.data()), static_cast<std::streamsize>(wanted));
  const auto got = static_cast<std::size_t>(in_.gcount());
  left_ -= got;
  state_.next_in = piece_.data();
  state_.avail_in = static_cast<uInt>(got);
  return got > 0;
}

}  // namespace episcope::io
