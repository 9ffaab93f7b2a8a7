// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/deflated_npy.h"

#include "engine/core/error.h"
#include "engine/io/arrays/npy_file.h"

#include <algorithm>
#include <vector>

namespace episcope::io {

NpyHeader read_zipped_header(const std::filesystem::path& path, const ZipEntry& entry) {
  if (!entry.is_deflated) return NpyFile(path, entry.begin, entry.stored).header();
  std::vector<std::uint8_t> begin(
      std::min<std::uint64_t>(entry.size, kLongestNpyHeader + kNpyPrefix));
  begin.resize(InflateStream(path, entry).read(begin.size(), begin.data()));
  return parse_npy_header(path, {reinterpret_cast<const char*>(begin.data()), begin.size()});
}

DeflatedNpy::DeflatedNpy(const std::filesystem::path& path, const ZipEntry& entry, NpyHeader header)
    : LinearArray(path, stored_shape(header), header.type),
      entry_(entry),
      header_(std::move(header)),
      stream_(std::make_unique<InflateStream>(path, entry)) {}

void DeflatedNpy::read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const {
  const std::size_t bytes = count * byte_size(type());
  const std::uint64_t begin = header_.bytes + first * byte_size(type());
  if (begin < stream_->position()) stream_ = std::make_unique<InflateStream>(path(), entry_);
  if (!stream_->skip_to(begin) || stream_->read(bytes, out) != bytes) {
    throw IoError(path(), entry_.name +
                              " in the zip archive is truncated or damaged; copy or save "
                              "it again");
  }
  if (header_.is_big_endian) swap_bytes(type(), count, out);
}

}  // namespace episcope::io
