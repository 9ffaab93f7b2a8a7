// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

/// Files of one row of bytes, the dataset "lf", made by HDF5 itself, whole and damaged.
namespace episcope::test {

using OnObject = std::function<void(hid_t)>;

/// Writes the file: `store` sets how the samples are stored, `fill` writes them.
void write_row(const std::filesystem::path& path, hsize_t length, const OnObject& store,
               const OnObject& fill);
/// Writes `count` bytes of 170 each.
void fill_row(hid_t dataset, std::size_t count);

/// Puts other bytes in the place of all of these, which must be there. Of equal length.
void replace_bytes(const std::filesystem::path& path, const std::string& bytes,
                   const std::string& by);

/// Reads a part of the row as the project does.
std::vector<std::uint8_t> read_row(const std::filesystem::path& path, std::size_t start,
                                   std::size_t count);

}  // namespace episcope::test
