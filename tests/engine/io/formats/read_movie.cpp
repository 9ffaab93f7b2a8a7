// SPDX-License-Identifier: BSD-3-Clause
#include "tests/engine/io/formats/read_movie.h"

#include <algorithm>
#include <memory>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libswscale/swscale.h>
}

namespace episcope {
namespace {

struct Close {
  void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
};

Image<std::uint8_t> picture_of(const AVFrame& frame) {
  const std::unique_ptr<SwsContext, Close> scaler(sws_getContext(
      frame.width, frame.height, static_cast<AVPixelFormat>(frame.format), frame.width,
      frame.height, AV_PIX_FMT_RGB24, SWS_POINT | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
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

}  // namespace

PlayedMovie read_movie(const std::filesystem::path& path) {
  AVFormatContext* opened = nullptr;
  if (avformat_open_input(&opened, path.c_str(), nullptr, nullptr) < 0) return {};
  const std::unique_ptr<AVFormatContext, Close> file(opened);
  if (avformat_find_stream_info(opened, nullptr) < 0 || opened->nb_streams != 1) return {};
  const AVStream& stream = *opened->streams[0];
  const AVCodec* const decoder = avcodec_find_decoder(stream.codecpar->codec_id);
  const std::unique_ptr<AVCodecContext, Close> codec(avcodec_alloc_context3(decoder));
  avcodec_parameters_to_context(codec.get(), stream.codecpar);
  if (avcodec_open2(codec.get(), decoder, nullptr) < 0) return {};
  const std::unique_ptr<AVPacket, Close> packet(av_packet_alloc());
  const std::unique_ptr<AVFrame, Close> frame(av_frame_alloc());
  PlayedMovie movie;
  bool is_at_end = false;
  while (!is_at_end) {
    is_at_end = av_read_frame(opened, packet.get()) < 0;
    if (!is_at_end) {
      movie.seconds += static_cast<double>(packet->duration) * av_q2d(stream.time_base);
    }
    avcodec_send_packet(codec.get(), is_at_end ? nullptr : packet.get());
    av_packet_unref(packet.get());
    while (avcodec_receive_frame(codec.get(), frame.get()) == 0) {
      movie.pictures.push_back(picture_of(*frame));
    }
  }
  // WebM tells the duration of the whole alone.
  if (movie.seconds == 0) movie.seconds = static_cast<double>(opened->duration) / AV_TIME_BASE;
  return movie;
}

}  // namespace episcope
