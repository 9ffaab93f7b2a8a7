// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_input.h"

#include <cstdint>
#include <filesystem>
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
/// No header of an array of numbers is longer.
constexpr std::size_t kLongestNpyHeader = 65536;

/// Whether a file that begins like this is an `.npy` file.
[[nodiscard]] bool has_npy_magic(std::string_view begin);

/// Parses the header at the front of a file; `begin` holds it, and may hold more. Nothing in it is
/// evaluated: objects, records and text are refused. Throws IoError that names `path`.
[[nodiscard]] NpyHeader parse_npy_header(const std::filesystem::path& path, std::string_view begin);

/// A header of version 1.0 for samples in C order of this machine, which must be little-endian.
[[nodiscard]] std::string npy_header(const ArrayShape& shape, NumberType type);

}  // namespace episcope::io
