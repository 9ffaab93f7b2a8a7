// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"
#include "engine/io/movie/movie_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>

struct AVCodecContext;
struct AVFilterContext;
struct AVFilterGraph;
struct AVFormatContext;
struct AVFrame;
struct AVPacket;

namespace episcope::io {

/// Whether the suffix of a path is one of the forms that MovieEncoder writes.
[[nodiscard]] bool is_encoded_form(const std::filesystem::path& path);

/// FFmpeg's filters, encoder and container for one file.
class MovieEncoder {
 public:
  /// `file` is written, messages name `named`, whose suffix tells the form. Throws IoError,
  /// Unavailable.
  MovieEncoder(const std::filesystem::path& file, const std::filesystem::path& named,
               const MovieShape& shape);

  /// An opaque RGBA8 picture of the shape. Throws IoError.
  void add(ImageView<const std::uint8_t> picture);
  /// No picture follows. Throws IoError.
  void finish();

 private:
  struct Free {
    void operator()(AVFilterGraph* graph) const;
    void operator()(AVCodecContext* codec) const;
    void operator()(AVFormatContext* container) const;
    void operator()(AVFrame* frame) const;
    void operator()(AVPacket* packet) const;
  };

  void make_filters();
  void open_container();
  void open_codec();
  void encode_what_is_ready();
  void write_packets();
  /// Throws IoError with FFmpeg's reason if `code` is one of an error.
  int require(int code) const;

  std::filesystem::path file_;
  std::filesystem::path named_;
  MovieShape shape_;
  std::int64_t count_ = 0;
  AVFilterContext* source_ = nullptr;  // of the graph
  AVFilterContext* sink_ = nullptr;
  std::unique_ptr<AVFilterGraph, Free> graph_;
  std::unique_ptr<AVFormatContext, Free> container_;
  std::unique_ptr<AVCodecContext, Free> codec_;
  std::unique_ptr<AVFrame, Free> frame_;
  std::unique_ptr<AVPacket, Free> packet_;
};

}  // namespace episcope::io
