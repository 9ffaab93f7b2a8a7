// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/film.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_header.h"
#include "engine/io/models/load_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/log.h>
#include <libswscale/swscale.h>
}

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

struct Free {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
  void operator()(AVDictionary* options) const { av_dict_free(&options); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

[[noreturn]] void refuse_film(const fs::path& path) {
  throw IoError(path,
                "the film cannot be decoded: it is damaged or in a form that this build of FFmpeg "
                "does not know; export its pictures as images, in a folder");
}

Image<std::uint8_t> picture_of(const fs::path& path, const AVFrame& frame) {
  const Owned<SwsContext> scaler(sws_getContext(
      frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
      frame.height, AV_PIX_FMT_RGB24, SWS_BICUBIC | SWS_FULL_CHR_H_INT | SWS_ACCURATE_RND, nullptr,
      nullptr, nullptr));
  if (!scaler) refuse_film(path);
  // Rows of any width may be written beyond their end by vector code.
  const int stride = (3 * frame.width + 63) / 64 * 64;
  std::vector<std::uint8_t> rows(static_cast<std::size_t>(stride) * frame.height + 64);
  std::uint8_t* const planes[4] = {rows.data(), nullptr, nullptr, nullptr};
  const int strides[4] = {stride, 0, 0, 0};
  sws_scale(scaler.get(), frame.data, frame.linesize, 0, frame.height, planes, strides);
  Image<std::uint8_t> picture(frame.height, frame.width, 3);
  for (int y = 0; y < frame.height; ++y) {
    std::copy_n(rows.data() + static_cast<std::ptrdiff_t>(y) * stride, 3 * frame.width,
                picture.row(y));
  }
  return picture;
}

std::uint64_t pixels_of(int height, int width) {
  return static_cast<std::uint64_t>(std::max(0, height)) *
         static_cast<std::uint64_t>(std::max(0, width));
}

/// Of one picture, for which decoders take memory as soon as it is claimed; they pad rows.
std::int64_t most_pixels(const fs::path& path) {
  constexpr std::uint64_t kMost = std::numeric_limits<int>::max();  // as an option of FFmpeg
  return static_cast<std::int64_t>(std::min(kMost, 2 * most_plausible_pixels(fs::file_size(path))));
}

void require_plausible_sizes(const fs::path& path, const AVFormatContext& file) {
  for (unsigned i = 0; i < file.nb_streams; ++i) {
    const AVCodecParameters& stream = *file.streams[i]->codecpar;
    require_plausible_pixels(path, pixels_of(stream.height, stream.width));
  }
}

bool find_streams(AVFormatContext& file, std::int64_t most_pixels) {
  std::vector<AVDictionary*> options(file.nb_streams, nullptr);
  for (AVDictionary*& each : options) av_dict_set_int(&each, "max_pixels", most_pixels, 0);
  const int code = avformat_find_stream_info(&file, options.data());
  for (AVDictionary*& each : options) av_dict_free(&each);
  return code >= 0;
}

/// Pictures that hardly change take few bytes, but some.
void require_plausible_film(const fs::path& path, std::uint64_t pixels) {
  constexpr std::uint64_t kFew = 64'000'000;
  constexpr std::uint64_t kMostOfByte = 20'000;
  const std::uintmax_t bytes = fs::file_size(path);
  if (pixels <= kFew || pixels / kMostOfByte <= bytes) return;
  throw IoError(path, fmt::format("the film cannot be decoded: it claims more than {} million "
                                  "pixels, which its {} bytes cannot hold; copy or export it again",
                                  pixels / 1'000'000, bytes));
}

/// The container, its first video and the decoder of that.
class FilmDecoder {
 public:
  explicit FilmDecoder(const fs::path& path) : path_(path) {
    av_log_set_level(AV_LOG_QUIET);
    AVDictionary* options = nullptr;
    av_dict_set(&options, "protocol_whitelist", "file", 0);
    // Lists of other files are none of these.
    av_dict_set(&options, "format_whitelist", "mov,matroska,avi,gif,apng", 0);
    AVFormatContext* opened = nullptr;
    const int code = avformat_open_input(&opened, path.c_str(), nullptr, &options);
    const Owned<AVDictionary> left(options);
    if (code < 0) refuse_film(path);
    file_.reset(opened);
    require_plausible_sizes(path, *opened);
    const std::int64_t most = most_pixels(path);
    if (!find_streams(*opened, most)) refuse_film(path);
    const AVCodec* codec = nullptr;
    stream_ = av_find_best_stream(opened, AVMEDIA_TYPE_VIDEO, -1, -1, &codec, 0);
    if (stream_ < 0 || codec == nullptr) refuse_film(path);
    codec_.reset(avcodec_alloc_context3(codec));
    const AVCodecParameters* const parameters = opened->streams[stream_]->codecpar;
    if (!codec_ || avcodec_parameters_to_context(codec_.get(), parameters) < 0) refuse_film(path);
    codec_->max_pixels = most;
    if (avcodec_open2(codec_.get(), codec, nullptr) < 0) refuse_film(path);
  }

  [[nodiscard]] std::string codec_name() const { return avcodec_get_name(codec_->codec_id); }

  /// Gives every picture to `take`.
  template <class Take>
  void decode(const Take& take) {
    const Owned<AVPacket> packet(av_packet_alloc());
    const Owned<AVFrame> frame(av_frame_alloc());
    bool is_at_end = false;
    while (!is_at_end) {
      is_at_end = av_read_frame(file_.get(), packet.get()) < 0;
      const bool is_other = !is_at_end && packet->stream_index != stream_;
      if (!is_other && avcodec_send_packet(codec_.get(), is_at_end ? nullptr : packet.get()) < 0) {
        refuse_film(path_);
      }
      av_packet_unref(packet.get());
      while (!is_other && avcodec_receive_frame(codec_.get(), frame.get()) == 0) take(*frame);
    }
  }

 private:
  fs::path path_;
  int stream_ = -1;
  Owned<AVFormatContext> file_;
  Owned<AVCodecContext> codec_;
};

}  // namespace

bool is_film_name(const fs::path& path) {
  constexpr std::array<std::string_view, 7> suffixes{".mp4",  ".mov", ".m4v", ".mkv",
                                                     ".webm", ".avi", ".gif"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

bool is_animated_png(const fs::path& path) {
  constexpr std::uint32_t kAnimation = 0x6163544c;  // "acTL"
  constexpr std::uint32_t kSamples = 0x49444154;    // "IDAT"
  constexpr std::uint32_t kFewestPictures = 3;
  constexpr int kMostChunks = 1000;
  if (suffix_of(path) != ".png" && suffix_of(path) != ".apng") return false;
  FileBytes file(path);
  if (!file.begins_with("\x89PNG\r\n\x1a\n")) return false;
  std::streamoff at = 8;
  for (int i = 0; i < kMostChunks && !file.is_short(); ++i) {
    const std::uint32_t type = file.number(at + 4, 4, false);
    if (type == kAnimation) return file.number(at + 8, 4, false) >= kFewestPictures;
    if (type == kSamples) return false;
    at += 12 + static_cast<std::streamoff>(file.number(at, 4, false));
  }
  return false;
}

Film read_film(const fs::path& path, int most, const Progress& progress) {
  require_readable_file(path);
  FilmDecoder decoder(path);
  Film film{{}, decoder.codec_name()};
  decoder.decode([&](const AVFrame& frame) {
    progress.check();
    const auto count = static_cast<int>(film.pictures.size());
    if (count == most) {
      throw IoError(path, fmt::format("the film has more than {} pictures, which are too many for "
                                      "views; cut the part that shows the light field",
                                      most));
    }
    const std::uint64_t pixels = pixels_of(frame.height, frame.width) * (film.pictures.size() + 1);
    require_plausible_film(path, pixels);
    require_view_memory(path, 2.0 * 3 * static_cast<double>(pixels));
    film.pictures.emplace_back(picture_of(path, frame));
    progress.report((count + 1.0) / most);
  });
  if (film.pictures.empty()) refuse_film(path);
  return film;
}

}  // namespace episcope::io
