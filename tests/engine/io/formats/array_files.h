// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::test {

/// Bytes of `[v][u][y][x][c]` in another order of axes, "cxyuv".
[[nodiscard]] std::vector<std::uint8_t> in_axes(const ViewStack<std::uint8_t>& views,
                                                const std::string& axes);

/// Lengths of the axes.
[[nodiscard]] std::vector<std::size_t> lengths_of(const ViewStack<std::uint8_t>& views,
                                                  const std::string& axes);

/// How a MATLAB 5 file is to look like.
struct Mat5Form {
  bool is_compressed = false;
  bool is_double = false;          ///< Samples in 0 … 1, not bytes.
  std::string structure{};         ///< Name of the struct that holds LF; empty = none.
  bool has_other = false;          ///< Further variables: text, a small matrix.
  ImageView<const float> label{};  ///< Further variable `label`, of doubles.
};

/// Writes LF(t, s, v, u, c) by libmatio.
void write_mat5(const std::filesystem::path& path, const ViewStack<std::uint8_t>& views,
                const Mat5Form& form);

/// What holds the views of a MATLAB 5 file.
enum class Mat5Views { Cells, Structs };

/// Writes views (v, u, c) as LF{t, s}, a cell array, or LF(t, s).img, by libmatio.
void write_mat5_cells(const std::filesystem::path& path, const ViewStack<std::uint8_t>& views,
                      bool is_compressed, Mat5Views form = Mat5Views::Cells);

/// Writes one 2-D array of doubles, not compressed.
void write_mat5_map(const std::filesystem::path& path, const std::string& name,
                    ImageView<const float> map);

/// A file for a zip archive.
struct ZippedFile {
  std::string name;
  std::string bytes;
};
/// Deflates the files.
void write_deflated_zip(const std::filesystem::path& path, const std::vector<ZippedFile>& files);

[[nodiscard]] std::string bytes_of_file(const std::filesystem::path& path);

}  // namespace episcope::test
