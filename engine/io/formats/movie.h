// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"

#include <cstdint>
#include <filesystem>
#include <memory>

namespace episcope::io {

/// Size and speed of a movie.
struct MovieShape {
  int height = 0;  ///< Of the pictures that are given, px.
  int width = 0;
  double rate = 10;  ///< Pictures per second; 0.1 … 120.
  /// Pixels across the movie, whose height follows; 0 = as the pictures. MP4 and WebM round
  /// both sizes to even numbers.
  int width_shown = 0;
};

/// Whether a path names a movie: ".mp4", ".webm", ".gif", or no suffix: a folder of PNG images.
[[nodiscard]] bool is_movie_path(const std::filesystem::path& path);

/// A film of pictures that appears under its name only when it is complete. MP4 is H.264, WebM is
/// VP9, both 4:2:0; GIF has one palette for all of it and repeats for ever; a path without a suffix
/// becomes a folder of `frame_0000.png` and so on.
class MovieFile {
 public:
  /// Throws IoError if nothing can be written there, InvalidInput if the path or the shape is none
  /// of a movie, Unavailable if this build of FFmpeg lacks the encoder.
  MovieFile(const std::filesystem::path& path, const MovieShape& shape);
  ~MovieFile();
  MovieFile(const MovieFile&) = delete;
  MovieFile& operator=(const MovieFile&) = delete;

  /// The next picture: RGBA8, `[y][x][4]`, of the size of the shape; transparent pixels become
  /// white. Throws IoError.
  void add(ImageView<const std::uint8_t> picture);
  /// Throws IoError that names the path; InvalidInput if there is no picture.
  void commit();

 private:
  class Sink;
  class Encoded;
  class Numbered;
  [[nodiscard]] static std::unique_ptr<Sink> sink_for(const std::filesystem::path& path,
                                                      const MovieShape& shape);

  MovieShape shape_;
  Image<std::uint8_t> opaque_;
  int count_ = 0;
  std::unique_ptr<Sink> sink_;
};

}  // namespace episcope::io
