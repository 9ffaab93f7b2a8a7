// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/zip_writer.h"

#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <zlib.h>

#include <algorithm>

namespace episcope::io {
namespace {

constexpr std::uint64_t kIn64 = 0xFFFFFFFF;
constexpr std::uint64_t kMostIn16 = 0xFFFF;
constexpr std::uint16_t kVersion64 = 45;
constexpr std::uint16_t kVersion = 20;
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
  return static_cast<std::uint32_t>(std::min(value, kIn64));
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
  header.add(std::uint32_t{0x04034B50}).add(is_large ? kVersion64 : kVersion);
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
    record.add(std::uint32_t{0x02014B50}).add(kVersion64).add(is_large ? kVersion64 : kVersion);
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
    end.add(std::uint32_t{0x06064B50}).add(std::uint64_t{44}).add(kVersion64).add(kVersion64);
    end.add(std::uint32_t{0}).add(std::uint32_t{0}).add(count).add(count).add(bytes).add(begin);
    end.add(std::uint32_t{0x07064B50}).add(std::uint32_t{0}).add(position_).add(std::uint32_t{1});
  }
  const auto short_count = static_cast<std::uint16_t>(std::min(count, kMostIn16));
  end.add(std::uint32_t{0x06054B50}).add(std::uint16_t{0}).add(std::uint16_t{0});
  end.add(short_count).add(short_count).add(in_32(bytes)).add(in_32(begin)).add(std::uint16_t{0});
  write(end.bytes());
  file_ = FileDescriptor();
}

}  // namespace episcope::io
