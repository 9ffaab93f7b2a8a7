// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/io/arrays/array_input.h"
#include "engine/io/arrays/npy_header.h"
#include "engine/io/durable/file_descriptor.h"

#include <cstdint>
#include <filesystem>
#include <span>

namespace episcope::io {

/// An `.npy` file (versions 1 to 3; integers, booleans, floats of 16 to 64 bits; any byte order, C
/// or Fortran order), read when it is needed. Arrays in Fortran order have their axes reversed in
/// `shape`, so that the last is contiguous.
class NpyFile : public LinearArray {
 public:
  /// `offset`: where in the file the `.npy` data begins, and `bytes` how many there are at most;
  /// for arrays inside of an archive. Throws IoError for a file of another kind, for objects,
  /// records or text, and if the file is shorter than its header states.
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
/// Likewise, of integers; floats are accepted if all are whole numbers.
[[nodiscard]] Image<std::int32_t> read_npy_labels(const std::filesystem::path& path);

/// Both, of any array whose axes are in C order of the file; `is_transposed` swaps y and x.
[[nodiscard]] Image<float> read_map(const ArrayInput& array, bool is_transposed);
[[nodiscard]] Image<std::int32_t> read_label_map(const ArrayInput& array, bool is_transposed);

/// Writes a file of version 1.0 in C order. Atomic. T: uint8, uint16, int32, float. Throws IoError;
/// InvalidInput if the shape is not that of the samples.
template <class T>
void write_npy(const std::filesystem::path& path, const ArrayShape& shape,
               std::span<const T> samples);

}  // namespace episcope::io
