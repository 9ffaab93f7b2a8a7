// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/npy_file.h"

#include "engine/core/array/transposed.h"
#include "engine/core/array/whole_int.h"
#include "engine/core/error.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/system_error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace episcope::io {
namespace {

/// Reads up to `bytes`; fewer at the end of the file or if the disk fails.
std::size_t read_at(const FileDescriptor& file, std::uint64_t offset, std::size_t bytes,
                    std::uint8_t* out) {
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t got =
        pread(file.id(), out + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

/// Height and width: the lengths other than 1, or the last two.
ArrayShape map_size(const ArrayInput& array) {
  ArrayShape size;
  for (const std::size_t length : array.shape()) {
    if (length != 1) size.push_back(length);
  }
  while (size.size() < 2 && array.shape().size() >= 2) size.insert(size.begin(), 1);
  const bool is_map =
      size.size() == 2 && size[0] > 0 && size[1] > 0 && size[0] <= 1 << 20 && size[1] <= 1 << 20;
  if (is_map) return size;
  throw IoError(array.path(), fmt::format("the array has the shape {}, but a map has height × "
                                          "width; save one map alone",
                                          array_shape_text(array.shape())));
}

template <class T>
Image<T> read_image(const ArrayInput& array, bool is_transposed) {
  const ArrayShape size = map_size(array);
  Image<T> image(static_cast<int>(size[0]), static_cast<int>(size[1]));
  array.read(ArrayShape(array.shape().size(), 0), array.shape(), image.data());
  return is_transposed ? transposed(image) : image;
}

}  // namespace

ArrayShape stored_shape(const NpyHeader& header) {
  ArrayShape shape = header.shape;
  if (header.is_fortran) std::ranges::reverse(shape);
  return shape;
}

NpyFile::Place NpyFile::find(const std::filesystem::path& path, std::uint64_t offset,
                             std::uint64_t bytes) {
  require_readable_file(path);
  Place place{FileDescriptor(path, O_RDONLY), 0, {}};
  if (!place.file.ok()) throw IoError(path, "the file cannot be opened; check its permissions");
  const std::uint64_t size = std::filesystem::file_size(path);
  const std::uint64_t held = std::min(bytes, size - std::min(offset, size));
  std::vector<std::uint8_t> begin(std::min<std::size_t>(held, kLongestNpyHeader + kNpyPrefix));
  begin.resize(read_at(place.file, offset, begin.size(), begin.data()));
  place.header =
      parse_npy_header(path, {reinterpret_cast<const char*>(begin.data()), begin.size()});
  const std::size_t elements = element_count(place.header.shape);
  const std::size_t width = byte_size(place.header.type);
  if (elements > (held - place.header.bytes) / width) {
    throw IoError(path,
                  fmt::format("the .npy header states {} {} samples, but the file ends after "
                              "{} of them; copy or save it again",
                              array_shape_text(place.header.shape), number_name(place.header.type),
                              (held - place.header.bytes) / width));
  }
  place.offset = offset + place.header.bytes;
  return place;
}

NpyFile::NpyFile(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t bytes)
    : NpyFile(path, find(path, offset, bytes)) {}

NpyFile::NpyFile(const std::filesystem::path& path, Place place)
    : LinearArray(path, stored_shape(place.header), place.header.type),
      file_(std::move(place.file)),
      samples_begin_(place.offset),
      header_(std::move(place.header)) {}

void NpyFile::read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const {
  const std::size_t width = byte_size(type());
  if (read_at(file_, samples_begin_ + first * width, count * width, out) != count * width) {
    throw IoError(path(), "the file cannot be read to its end; copy it again or check the disk");
  }
  if (header_.is_big_endian) swap_bytes(type(), count, out);
}

Image<float> read_map(const ArrayInput& array, bool is_transposed) {
  return read_image<float>(array, is_transposed);
}

Image<std::int32_t> read_label_map(const ArrayInput& array, bool is_transposed) {
  if (!is_float(array.type())) return read_image<std::int32_t>(array, is_transposed);
  const Image<float> numbers = read_image<float>(array, is_transposed);
  if (!std::all_of(numbers.begin(), numbers.end(),
                   [](float number) { return whole_int(number).has_value(); })) {
    throw IoError(array.path(),
                  "labels are expected to be whole numbers, but the array holds fractions; save "
                  "labels as integers");
  }
  Image<std::int32_t> labels(numbers.height(), numbers.width());
  std::transform(numbers.begin(), numbers.end(), labels.begin(),
                 [](float number) { return static_cast<std::int32_t>(number); });
  return labels;
}

Image<float> read_npy_map(const std::filesystem::path& path) {
  const NpyFile file(path);
  return read_map(file, file.header().is_fortran);
}

Image<std::int32_t> read_npy_labels(const std::filesystem::path& path) {
  const NpyFile file(path);
  return read_label_map(file, file.header().is_fortran);
}

template <class T>
void write_npy(const std::filesystem::path& path, const ArrayShape& shape,
               std::span<const T> samples) {
  if (element_count(shape) != samples.size()) {
    throw InvalidInput(fmt::format("an array of the shape {} cannot hold {} samples",
                                   array_shape_text(shape), samples.size()));
  }
  const std::string header = npy_header(shape, number_type_of<T>());
  AtomicFile file(path, header.size() + samples.size_bytes());
  {
    const FileDescriptor out(file.temporary(), O_WRONLY | O_TRUNC);
    const bool is_written =
        out.ok() &&
        write_all(out.id(),
                  {reinterpret_cast<const std::uint8_t*>(header.data()), header.size()}) &&
        write_all(out.id(),
                  {reinterpret_cast<const std::uint8_t*>(samples.data()), samples.size_bytes()});
    if (!is_written) throw write_error(path);
  }
  file.commit();
}

template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::uint8_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::uint16_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&,
                        std::span<const std::int32_t>);
template void write_npy(const std::filesystem::path&, const ArrayShape&, std::span<const float>);

}  // namespace episcope::io
