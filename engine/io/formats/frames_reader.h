// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Whether the suffix is one of films: .mp4, .mov, .m4v, .mkv, .webm, .avi, .gif.
[[nodiscard]] bool is_film_name(const std::filesystem::path& path);

/// The pictures of a film, or of an animated PNG, RGB8.
struct Film {
  std::vector<AnyImage> pictures;
  std::string codec;    ///< "h264".
  int orientation = 1;  ///< As in Exif, in which the film stores them; here they are upright.
};

/// Decodes the pictures of the first video in a file, in the order of display. No other file is
/// opened, whatever the file refers to. Throws IoError if it cannot be decoded, has more than
/// `most` pictures or more than memory can hold; Cancelled.
[[nodiscard]] Film read_film(const std::filesystem::path& path, int most, const Progress& progress);

/// A light field whose views are the pages of a TIFF file or the pictures of a film: row by row, in
/// another order that the views show, or along a line. A film is read if it is named itself, not
/// through its folder, since films are also made of light fields.
[[nodiscard]] Reader frames_reader();

}  // namespace episcope::io
