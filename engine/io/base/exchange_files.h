// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/point_cloud.h"

#include <filesystem>

namespace episcope::io {

/// Portable float map (Debevec): `Pf` (1 channel) or `PF` (3), rows stored bottom to top, a
/// negative scale means little endian; samples are multiplied by |scale|. Returned with row 0 on
/// top; NaN and infinities are kept, a round trip is bit-exact. Throws IoError.
[[nodiscard]] Image<float> read_pfm(const std::filesystem::path& path);
/// Reads a map of one channel, or a gray picture of three. Throws IoError if the three differ.
[[nodiscard]] Image<float> read_pfm_map(const std::filesystem::path& path);
/// Little endian, scale −1. Atomic. Throws IoError, InvalidInput for other than 1 or 3 channels.
void write_pfm(const std::filesystem::path& path, ImageView<const float> image);

/// Whether the suffix is .txt, .csv or .dat.
[[nodiscard]] bool has_text_suffix(const std::filesystem::path& path);
/// Whether such a file begins with a row of at least eight numbers, as NumPy, MATLAB and
/// spreadsheets write matrices. Reads the beginning of the file only.
[[nodiscard]] bool is_text_map(const std::filesystem::path& path);

/// Reads a map as text, a line for each row of pixels, top to bottom: numbers between commas,
/// semicolons, tabs or spaces, with a decimal point, or a comma where no commas part them. Empty
/// cells and words such as nan are NaN; empty lines and lines that begin with # or % are skipped.
/// Throws IoError that names the line, and for more than 400 MB.
[[nodiscard]] Image<float> read_text_map(const std::filesystem::path& path);

/// Writes such a map with commas; numbers read back exactly, NaN and infinite values as nan.
/// Atomic. Throws IoError.
void write_csv_map(const std::filesystem::path& path, ImageView<const float> map);

enum class PlyForm { Binary, Text };

/// Writes PLY, axes as `PointCloud`: x to the right, y upwards, the viewer looks along −z.
/// Triangles become faces. Atomic. Throws IoError, InvalidInput if there is no point.
void write_ply(const std::filesystem::path& path, const PointCloud& cloud,
               PlyForm form = PlyForm::Binary);

}  // namespace episcope::io
