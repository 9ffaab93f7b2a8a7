// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/frames_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/light_field.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/formats/tiff_pages.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/motion_pictures.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/display.h>
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

/// The Exif orientation whose turn a matrix of a film states; 0 = none does.
int orientation_of(const std::array<std::int32_t, 9>& matrix) {
  constexpr std::int32_t kOne = 1 << 16;
  // Where columns (first pair) and rows of stored pixels point to on the screen, as (right, down).
  constexpr std::array<std::array<int, 4>, 8> kTurns{{{1, 0, 0, 1},
                                                      {-1, 0, 0, 1},
                                                      {-1, 0, 0, -1},
                                                      {1, 0, 0, -1},
                                                      {0, 1, 1, 0},
                                                      {0, 1, -1, 0},
                                                      {0, -1, -1, 0},
                                                      {0, -1, 1, 0}}};
  for (std::size_t i = 0; i < kTurns.size(); ++i) {
    const auto& turn = kTurns[i];
    if (matrix[0] == turn[0] * kOne && matrix[1] == turn[1] * kOne && matrix[3] == turn[2] * kOne &&
        matrix[4] == turn[3] * kOne) {
      return static_cast<int>(i) + 1;
    }
  }
  return 0;
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

  /// How the camera was turned, as Exif tells it (load_views.h). Throws IoError for angles between
  /// quarters.
  [[nodiscard]] int orientation() const {
    const std::uint8_t* const stated =
        av_stream_get_side_data(file_->streams[stream_], AV_PKT_DATA_DISPLAYMATRIX, nullptr);
    if (stated == nullptr) return 1;
    std::array<std::int32_t, 9> matrix;
    std::memcpy(matrix.data(), stated, sizeof matrix);
    if (const int found = orientation_of(matrix)) return found;
    throw IoError(
        path_, fmt::format("the film states that its pictures are turned by {:.1f}°, which is no "
                           "quarter of a turn; export its pictures upright, as images in a folder",
                           -av_display_rotation_get(matrix.data())));
  }

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

// Whether a PNG file states that it holds three pictures or more (APNG).
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

}  // namespace

bool is_film_name(const fs::path& path) {
  constexpr std::array<std::string_view, 7> suffixes{".mp4",  ".mov", ".m4v", ".mkv",
                                                     ".webm", ".avi", ".gif"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

Film read_film(const fs::path& path, int most, const Progress& progress) {
  require_readable_file(path);
  FilmDecoder decoder(path);
  Film film{{}, decoder.codec_name(), decoder.orientation()};
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
    film.pictures.push_back(upright(picture_of(path, frame), film.orientation));
    progress.report((count + 1.0) / most);
  });
  if (film.pictures.empty()) refuse_film(path);
  return film;
}

namespace {

constexpr int kChannels = 3;

template <class T>
ViewStack<T> joined_channels(const ViewStack<T>& pages, const PageOrder& order) {
  const int views = pages.grid().count() / order.channels;
  ViewStack<T> colored({1, views}, pages.height(), pages.width(), kChannels, {},
                       allocate_large_zeros);
  for (int view = 0; view < views; ++view) {
    for (int channel = 0; channel < std::min(order.channels, kChannels); ++channel) {
      const T* from = pages.view({0, order.page(view, channel)}).data;
      T* to = colored.view({0, view}).data + channel;
      for (std::size_t n = 0; n < pages.view_size(); ++n) to[n * kChannels] = from[n];
    }
  }
  return colored;
}

namespace fs = std::filesystem;

constexpr int kMostPictures = 1000;
constexpr int kFewestPages = 3;  ///< Two may be a picture and its thumbnail.

bool has_tiff_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".tif" || suffix == ".tiff";
}

bool has_pages(const fs::path& path) {
  return has_tiff_name(path) && count_tiff_pages(path, kMostPictures) >= kFewestPages;
}

fs::path find_frames(const fs::path& path, const OpenOptions& options) {
  if (options.mosaic != Mosaic::Auto || options.lenslet > 0) return {};
  if (!fs::is_directory(path))
    return has_pages(path) || is_film_name(path) || is_animated_png(path) ? path : fs::path();
  const std::vector<fs::path> images = list_images(path);
  const bool is_one =
      images.size() == 1 && (has_pages(images.front()) || is_animated_png(images.front()));
  return is_one ? images.front() : fs::path();
}

struct Frames {
  std::vector<AnyImage> pictures;
  std::string what;                         ///< "pages", "pictures of a film (h264)".
  std::vector<Image<std::uint8_t>> seen{};  ///< As in SeenImage; empty = all as a whole.
  int orientation = 1;                      ///< In which they are stored.
};

/// Throws IoError if pages state that they were cut out at different places.
void require_one_place(const fs::path& path) {
  const std::vector<PagePlace> places = stated_places(path);
  const auto other =
      std::ranges::find_if(places, [&](const PagePlace& place) { return place != places.front(); });
  if (other == places.end()) return;
  throw IoError(path, fmt::format("page {} states that it lies at ({}, {}) px, but the first at "
                                  "({}, {}); cut all pages at one place, or remove what they state",
                                  other - places.begin(), other->x, other->y, places.front().x,
                                  places.front().y));
}

Frames read_frames(const fs::path& path, const Progress& progress) {
  if (!has_tiff_name(path)) {
    Film film = read_film(path, kMostPictures, progress);
    return {
        std::move(film.pictures), "pictures of a film (" + film.codec + ")", {}, film.orientation};
  }
  const int pages = count_tiff_pages(path, kMostPictures);
  if (pages > kMostPictures) {
    throw IoError(path, fmt::format("the file has more than {} pages, which are too many for views",
                                    kMostPictures));
  }
  const ImageHeader header = read_image_header(path);
  require_view_memory(path, 8.0 * header.height * header.width * header.channels * pages);
  require_one_place(path);
  Frames frames{read_imagej_pages(path), "pages of a TIFF file"};
  if (!frames.pictures.empty()) return frames;
  for (SeenImage& page : decode_pages(path, pages)) {
    frames.pictures.push_back(std::move(page.image));
    frames.seen.push_back(std::move(page.seen));
  }
  return frames;
}

template <class T>
ViewStack<T> stack_of(const fs::path& path, const std::vector<AnyImage>& pictures) {
  const auto& first = std::get<Image<T>>(pictures.front());
  const auto count = static_cast<int>(pictures.size());
  ViewStack<T> stack({1, count}, first.height(), first.width(), first.channels());
  for (int i = 0; i < count; ++i) {
    const AnyImage& picture = pictures[static_cast<std::size_t>(i)];
    const auto* image = std::get_if<Image<T>>(&picture);
    if (image == nullptr || image->height() != first.height() || image->width() != first.width() ||
        image->channels() != first.channels()) {
      throw IoError(path,
                    fmt::format("picture {} has {}, but the first one has {}; all views must "
                                "match",
                                i, describe_image(picture), describe_image(pictures.front())));
    }
    std::copy_n(image->data(), image->size(), stack.view({0, i}).data);
  }
  return stack;
}

LightField::Samples samples_of(const fs::path& path, const std::vector<AnyImage>& pictures) {
  return std::visit(
      [&]<class T>(const Image<T>&) -> LightField::Samples { return stack_of<T>(path, pictures); },
      pictures.front());
}

/// Pages that are channels of a view, as the file says.
void join_channels(LightField::Samples& samples, const std::optional<StatedPages>& stated,
                   std::string& reason, std::vector<std::string>& warnings) {
  const bool is_grey = std::visit([](const auto& stack) { return stack.channels() == 1; }, samples);
  if (!is_grey || !stated || stated->order.channels < 2) return;
  const int channels = stated->order.channels;
  std::visit([&](auto& stack) { stack = joined_channels(stack, stated->order); }, samples);
  reason += fmt::format(", each {} of them the channels of a view, as {} wrote", channels,
                        stated->program);
  if (channels == 2) reason += ", shown as red and green";
  if (channels > 3) warnings.push_back(fmt::format(finding_text("views.channels"), channels));
}

Scene read_light_field(const fs::path& path, const OpenOptions& options, const Progress& progress) {
  progress.step("reading the pictures");
  Frames frames = read_frames(path, progress.part(0, 0.6));
  Scene scene;
  SceneParts parts;
  parts.info = {
      scene_name(path), path.string(), {}, std::nullopt, {.reader = "frames", .options = {}}};
  parts.samples = samples_of(path, frames.pictures);
  const std::size_t count = frames.pictures.size();
  parts.valid = std::visit(
      [&](const auto& stack) {
        return joined_seen(frames.seen, stack.grid(), {stack.height(), stack.width()});
      },
      parts.samples);
  frames.pictures.clear();
  if (frames.orientation != 1) {
    scene.convention.warnings.push_back(fmt::format(
        finding_text("exif.film"), orientation_text(frames.orientation), frames.orientation));
  }
  settle_range(parts.samples, options.levels, scene.convention);
  std::string reason = fmt::format("{} {}", count, frames.what);
  const auto stated = has_tiff_name(path)
                          ? stated_pages(tiff_description(path), static_cast<int>(count))
                          : std::nullopt;
  join_channels(parts.samples, stated, reason, scene.convention.warnings);
  arrange_list(path, options, parts, reason, progress.part(0.6, 0.8),
               stated ? stated->grid : std::nullopt);
  scene.convention.format = reason;
  scene.convention.units = "no depth in such a file";
  if (options.on_center_view) {
    std::visit(
        [&](const auto& stack) {
          options.on_center_view(preview_rgb(stack.view(stack.grid().center())), parts.info,
                                 stack.grid());
        },
        parts.samples);
  }
  parts.expected.reason = finding_text("order.of_pictures");
  parts.files = {{"light field", 1, path.filename().string(), true}};
  assemble(std::move(parts), options, scene, progress.part(0.8, 1));
  return scene;
}

SceneProbe probe_frames(const fs::path& path, const OpenOptions& options) {
  if (!has_tiff_name(path)) return {};
  const ImageHeader header = read_image_header(path);
  return {.grid = given_grid(options).value_or(GridShape()),
          .height = header.height,
          .width = header.width,
          .channels = header.channels,
          .sample_type = header.sample_type,
          .list = count_tiff_pages(path, kMostPictures)};
}

constexpr const char* kFrameOptions[] = {"flip", "grid", "crop", "levels"};

}  // namespace

Reader frames_reader() {
  return {.id = "frames",
          .name = "pages of a TIFF file, or a film",
          .options = kFrameOptions,
          .find = find_frames,
          .read = read_light_field,
          .probe = probe_frames};
}

}  // namespace episcope::io
