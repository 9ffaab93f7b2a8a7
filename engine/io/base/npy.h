// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/io/base/array_input.h"
#include "engine/io/base/files.h"
#include "engine/io/base/zip.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace episcope::io {

/// What the header of an `.npy` file says. Source: numpy.lib.format, versions 1.0 to 3.0.
struct NpyHeader {
  ArrayShape shape;  ///< As NumPy shows it.
  NumberType type = NumberType::UInt8;
  bool is_big_endian = false;
  bool is_fortran = false;  ///< The first axis is contiguous, not the last.
  std::size_t bytes = 0;    ///< Length of the header: where the samples begin.
};

/// Bytes that suffice to know how long the header is.
constexpr std::size_t kNpyPrefix = 12;

/// Whether a file that begins like this is an `.npy` file.
[[nodiscard]] bool has_npy_magic(std::string_view begin);

/// A header of version 1.0 for samples in C order of this machine, which must be little-endian.
[[nodiscard]] std::string npy_header(const ArrayShape& shape, NumberType type);

/// An `.npy` file, read on demand: versions 1 to 3; integers, booleans, floats of 16 to 64 bits;
/// any byte order, C or Fortran order. Arrays in Fortran order have their axes reversed in `shape`,
/// so that the last is contiguous.
class NpyFile : public LinearArray {
 public:
  /// `offset`: where in the file the `.npy` data begins, and `bytes` how many there are at most;
  /// for arrays inside an archive. Throws IoError for a file of another kind, for objects, records
  /// or text, and if the file is shorter than its header states.
  explicit NpyFile(const std::filesystem::path& path, std::uint64_t offset = 0,
                   std::uint64_t bytes = ~std::uint64_t{0});

  [[nodiscard]] const NpyHeader& header() const { return header_; }

 private:
  struct Place {
    FileDescriptor file;
    std::uint64_t offset = 0;
    NpyHeader header;
  };
  static Place find(const std::filesystem::path& path, std::uint64_t offset, std::uint64_t bytes);
  NpyFile(const std::filesystem::path& path, Place place);
  void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const override;

  FileDescriptor file_;
  std::uint64_t samples_begin_ = 0;
  NpyHeader header_;
};

/// The shape with the contiguous axis last.
[[nodiscard]] ArrayShape stored_shape(const NpyHeader& header);

/// An array as a map `[y][x]` of numbers: 2-D, or with further axes of length 1. Throws IoError
/// that says what the file holds.
[[nodiscard]] Image<float> read_npy_map(const std::filesystem::path& path);
/// Reads an array as a map of integers; floats are accepted if all are whole numbers.
[[nodiscard]] Image<std::int32_t> read_npy_labels(const std::filesystem::path& path);

/// Read such maps from any array with axes in C order; `is_transposed` swaps y and x.
[[nodiscard]] Image<float> read_map(const ArrayInput& array, bool is_transposed);
[[nodiscard]] Image<std::int32_t> read_label_map(const ArrayInput& array, bool is_transposed);

/// Writes a file of version 1.0 in C order. Atomic. T: uint8, uint16, int32, float. Throws IoError;
/// InvalidInput if the shape does not match the samples.
template <class T>
void write_npy(const std::filesystem::path& path, const ArrayShape& shape,
               std::span<const T> samples);

/// Reads the header of an `.npy` file inside an archive. Throws IoError.
[[nodiscard]] NpyHeader read_zipped_header(const std::filesystem::path& path,
                                           const ZipEntry& entry);

/// Opens an `.npy` file inside an archive, stored or deflated; a deflated one is inflated piece by
/// piece while it is read. Throws IoError.
[[nodiscard]] std::unique_ptr<ArrayInput> open_zipped_npy(const std::filesystem::path& path,
                                                          const ZipEntry& entry);

}  // namespace episcope::io
