// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/movie.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/atomic_file.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
}

namespace episcope::io {
namespace {

// What a suffix stands for.
struct MovieForm {
  const char* suffix;
  const char* container;
  const char* encoder;
  const char* quality;  // options of the encoder, key=value:…
  const char* filters;  // after scaling
  bool needs_even_sizes;
};

constexpr MovieForm kMovieForms[] = {
    {".mp4", "mp4", "libx264", "crf=18:preset=medium", "format=yuv420p", true},
    {".webm", "webm", "libvpx-vp9", "crf=24:b=0:row-mt=1:deadline=good:cpu-used=4",
     "format=yuv420p", true},
    {".gif", "gif", "gif", "",
     "split[a][b];[a]palettegen[palette];[b][palette]paletteuse=dither=sierra2_4a", false},
};

const MovieForm* find_movie_form(const std::filesystem::path& path) {
  const std::string suffix = suffix_of(path);
  for (const MovieForm& form : kMovieForms) {
    if (suffix == form.suffix) return &form;
  }
  return nullptr;
}

const MovieForm& movie_form(const std::filesystem::path& path) {
  if (const MovieForm* form = find_movie_form(path)) return *form;
  throw InvalidInput(path.string() + " names no movie; use .mp4, .webm or .gif");
}

AVRational rate_of(const MovieShape& shape) {
  return av_d2q(shape.rate, 1000);
}

std::string filters_of(const MovieForm& form, const MovieShape& shape) {
  const int step = form.needs_even_sizes ? 2 : 1;
  const auto rounded = [&](double size) {
    return std::max(step, step * static_cast<int>(std::lround(size / step)));
  };
  const int wanted = shape.width_shown > 0 ? shape.width_shown : shape.width;
  const int width = rounded(wanted);
  const int height = rounded(static_cast<double>(shape.height) * wanted / shape.width);
  return fmt::format("scale={}:{}:flags=lanczos,{}", width, height, form.filters);
}

bool is_of_disk(int error) {
  return error == ENOSPC || error == EDQUOT || error == EFBIG || error == EROFS || error == EIO;
}

/// Whether the suffix of a path is one of the forms that MovieEncoder writes.
bool is_encoded_form(const std::filesystem::path& path) {
  return find_movie_form(path) != nullptr;
}

}  // namespace

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

void MovieEncoder::Free::operator()(AVFilterGraph* graph) const {
  avfilter_graph_free(&graph);
}
void MovieEncoder::Free::operator()(AVCodecContext* codec) const {
  avcodec_free_context(&codec);
}
void MovieEncoder::Free::operator()(AVFormatContext* container) const {
  avio_closep(&container->pb);
  avformat_free_context(container);
}
void MovieEncoder::Free::operator()(AVFrame* frame) const {
  av_frame_free(&frame);
}
void MovieEncoder::Free::operator()(AVPacket* packet) const {
  av_packet_free(&packet);
}

MovieEncoder::MovieEncoder(const std::filesystem::path& file, const std::filesystem::path& named,
                           const MovieShape& shape)
    : file_(file),
      named_(named),
      shape_(shape),
      graph_(avfilter_graph_alloc()),
      frame_(av_frame_alloc()),
      packet_(av_packet_alloc()) {
  if (!graph_ || !frame_ || !packet_) throw std::bad_alloc();
  av_log_set_level(AV_LOG_QUIET);
  make_filters();
  open_container();
  open_codec();
  AVStream* const stream = avformat_new_stream(container_.get(), nullptr);
  if (!stream) throw std::bad_alloc();
  stream->time_base = codec_->time_base;
  require(avcodec_parameters_from_context(stream->codecpar, codec_.get()));
  require(avformat_write_header(container_.get(), nullptr));
}

int MovieEncoder::require(int code) const {
  if (code >= 0) return code;
  if (const int error = AVUNERROR(code); is_of_disk(error)) {
    errno = error;
    throw write_error(named_);
  }
  char why[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, why, sizeof why);
  throw IoError(named_, std::string("the movie cannot be written (") + why + ")");
}

void MovieEncoder::make_filters() {
  const AVRational rate = rate_of(shape_);
  const std::string input = fmt::format(
      "video_size={}x{}:pix_fmt={}:time_base={}/{}:frame_rate={}/{}", shape_.width, shape_.height,
      static_cast<int>(AV_PIX_FMT_RGBA), rate.den, rate.num, rate.num, rate.den);
  require(avfilter_graph_create_filter(&source_, avfilter_get_by_name("buffer"), "in",
                                       input.c_str(), nullptr, graph_.get()));
  require(avfilter_graph_create_filter(&sink_, avfilter_get_by_name("buffersink"), "out", nullptr,
                                       nullptr, graph_.get()));
  AVFilterInOut* open_output = avfilter_inout_alloc();
  AVFilterInOut* open_input = avfilter_inout_alloc();
  if (!open_output || !open_input) throw std::bad_alloc();
  *open_output = {av_strdup("in"), source_, 0, nullptr};
  *open_input = {av_strdup("out"), sink_, 0, nullptr};
  const std::string filters = filters_of(movie_form(named_), shape_);
  const int code =
      avfilter_graph_parse_ptr(graph_.get(), filters.c_str(), &open_input, &open_output, nullptr);
  avfilter_inout_free(&open_output);
  avfilter_inout_free(&open_input);
  require(code);
  require(avfilter_graph_config(graph_.get(), nullptr));
}

void MovieEncoder::open_container() {
  AVFormatContext* container = nullptr;
  require(
      avformat_alloc_output_context2(&container, nullptr, movie_form(named_).container, nullptr));
  container_.reset(container);
  container->flags |= AVFMT_FLAG_BITEXACT;  // no date and version in the file
  // A folder can be named as if the path were an address.
  const std::string file = "file:" + file_.string();
  require(avio_open(&container->pb, file.c_str(), AVIO_FLAG_WRITE));
}

void MovieEncoder::open_codec() {
  const MovieForm& form = movie_form(named_);
  const AVCodec* const encoder = avcodec_find_encoder_by_name(form.encoder);
  if (!encoder) {
    throw Unavailable(std::string("this build of FFmpeg has no encoder ") + form.encoder +
                      "; choose another form of movie");
  }
  codec_.reset(avcodec_alloc_context3(encoder));
  if (!codec_) throw std::bad_alloc();
  codec_->width = av_buffersink_get_w(sink_);
  codec_->height = av_buffersink_get_h(sink_);
  codec_->pix_fmt = static_cast<AVPixelFormat>(av_buffersink_get_format(sink_));
  codec_->time_base = av_buffersink_get_time_base(sink_);
  codec_->framerate = rate_of(shape_);
  if ((container_->oformat->flags & AVFMT_GLOBALHEADER) != 0)
    codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AVDictionary* options = nullptr;
  av_dict_parse_string(&options, form.quality, "=", ":", 0);
  const int code = avcodec_open2(codec_.get(), encoder, &options);
  av_dict_free(&options);
  require(code);
}

void MovieEncoder::add(ImageView<const std::uint8_t> picture) {
  AVFrame* const frame = frame_.get();
  frame->format = AV_PIX_FMT_RGBA;
  frame->width = shape_.width;
  frame->height = shape_.height;
  frame->pts = count_++;
  require(av_frame_get_buffer(frame, 0));
  for (int y = 0; y < picture.height; ++y) {
    std::memcpy(frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0],
                picture.row(y), static_cast<std::size_t>(4) * picture.width);
  }
  require(av_buffersrc_add_frame(source_, frame));
  encode_what_is_ready();
}

void MovieEncoder::encode_what_is_ready() {
  for (;;) {
    const int code = av_buffersink_get_frame(sink_, frame_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    require(code);
    frame_->pict_type = AV_PICTURE_TYPE_NONE;
    require(avcodec_send_frame(codec_.get(), frame_.get()));
    av_frame_unref(frame_.get());
    write_packets();
  }
}

void MovieEncoder::write_packets() {
  for (;;) {
    const int code = avcodec_receive_packet(codec_.get(), packet_.get());
    if (code == AVERROR(EAGAIN) || code == AVERROR_EOF) return;
    require(code);
    const AVRational in_stream = container_->streams[0]->time_base;
    // All last as long; some encoders do not say so.
    if (packet_->duration == 0)
      packet_->duration = av_rescale_q(1, av_inv_q(rate_of(shape_)), codec_->time_base);
    av_packet_rescale_ts(packet_.get(), codec_->time_base, in_stream);
    require(av_interleaved_write_frame(container_.get(), packet_.get()));
  }
}

void MovieEncoder::finish() {
  require(av_buffersrc_add_frame(source_, nullptr));
  encode_what_is_ready();
  require(avcodec_send_frame(codec_.get(), nullptr));
  write_packets();
  require(av_write_trailer(container_.get()));
  require(avio_closep(&container_->pb));
}

namespace {

constexpr double kSlowest = 0.1, kFastest = 120;

void check(const std::filesystem::path& path, const MovieShape& shape) {
  if (!is_movie_path(path)) {
    throw InvalidInput(path.string() +
                       " names no movie; use .mp4, .webm or .gif, or a folder for PNG images");
  }
  if (shape.height < 1 || shape.width < 1) {
    throw InvalidInput(
        fmt::format("a movie of {}×{} px cannot be written", shape.width, shape.height));
  }
  if (!(shape.rate >= kSlowest && shape.rate <= kFastest)) {
    throw InvalidInput(fmt::format("a movie has {} to {} pictures per second, not {}", kSlowest,
                                   kFastest, shape.rate));
  }
}

// Over white.
void make_opaque(ImageView<const std::uint8_t> picture, Image<std::uint8_t>& out) {
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int opacity = picture.at(y, x, 3);
      for (int c = 0; c < 3; ++c) {
        const int mixed = picture.at(y, x, c) * opacity + 255 * (255 - opacity);
        out.at(y, x, c) = static_cast<std::uint8_t>((mixed + 127) / 255);
      }
      out.at(y, x, 3) = 255;
    }
  }
}

}  // namespace

/// Where pictures go.
class MovieFile::Sink {
 public:
  virtual ~Sink() = default;
  virtual void add(ImageView<const std::uint8_t> picture) = 0;
  virtual void commit() = 0;
};

class MovieFile::Encoded : public Sink {
 public:
  Encoded(const std::filesystem::path& path, const MovieShape& shape)
      : file_(path), encoder_(file_.temporary(), path, shape) {}
  void add(ImageView<const std::uint8_t> picture) override { encoder_.add(picture); }
  void commit() override {
    encoder_.finish();
    file_.commit();
  }

 private:
  AtomicFile file_;
  MovieEncoder encoder_;
};

class MovieFile::Numbered : public Sink {
 public:
  explicit Numbered(const std::filesystem::path& path) : folder_(path) {}
  void add(ImageView<const std::uint8_t> picture) override {
    write_picture(folder_.temporary() / fmt::format("frame_{:04}.png", number_++), picture);
  }
  void commit() override { folder_.commit(); }

 private:
  AtomicFolder folder_;
  int number_ = 0;
};

bool is_movie_path(const std::filesystem::path& path) {
  return suffix_of(path).empty() || is_encoded_form(path);
}

std::unique_ptr<MovieFile::Sink> MovieFile::sink_for(const std::filesystem::path& path,
                                                     const MovieShape& shape) {
  check(path, shape);
  if (suffix_of(path).empty()) return std::make_unique<Numbered>(path);
  return std::make_unique<Encoded>(path, shape);
}

MovieFile::MovieFile(const std::filesystem::path& path, const MovieShape& shape)
    : shape_(shape), opaque_(shape.height, shape.width, 4), sink_(sink_for(path, shape)) {}

MovieFile::~MovieFile() = default;

void MovieFile::add(ImageView<const std::uint8_t> picture) {
  if (picture.height != shape_.height || picture.width != shape_.width || picture.channels != 4) {
    throw InvalidInput(fmt::format("a picture of {}×{} px does not belong to a movie of {}×{} px",
                                   picture.width, picture.height, shape_.width, shape_.height));
  }
  make_opaque(picture, opaque_);
  sink_->add(opaque_.view());
  ++count_;
}

void MovieFile::commit() {
  if (count_ == 0) throw InvalidInput("a movie needs at least one picture");
  sink_->commit();
}

}  // namespace episcope::io
