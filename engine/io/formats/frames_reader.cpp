// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/frames_reader.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/light_field.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_header.h"
#include "engine/io/base/json.h"
#include "engine/io/base/sample_range.h"
#include "engine/io/formats/array_reader.h"
#include "engine/io/models/assemble_scene.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/load_views.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/order/warp_check.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

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

namespace {

constexpr int kChannels = 3;
constexpr int kFewestListedPages = 4;

/// Whether pages in the middle of the list differ by color, not by motion: motion that is too far
/// to be followed leaves pictures that are not alike.
bool are_channels(const LightField::Samples& samples, const PageOrder& order, int views) {
  constexpr double kAlike = 0.4;
  const int middle = views / 2;
  const auto picture = [&](int view, int channel) {
    return MotionPictures(grey_levels(samples, {0, order.page(view, channel)}));
  };
  const MotionPictures center = picture(middle, 1);
  AxisEvidence of_channels;
  AxisEvidence of_views;
  for (const int side : {-1, 1}) {
    const MotionPictures other = picture(middle, 1 + side);
    if (correlation(center.scales[1], other.scales[1]) < kAlike) return false;
    of_channels.add(center, other);
    if (middle + side < views) of_views.add(center, picture(middle + side, 1));
  }
  return are_rather_channels(of_channels, of_views);
}

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

/// The order of 3N grey pictures, 1×3N, of which each three are the channels of one, as ImageJ
/// stores colors of more than 8 bits, or each third of them is a channel: then views move, and
/// channels do not. Nothing if they do.
std::optional<PageOrder> find_channel_pages(const LightField::Samples& samples) {
  return std::visit(
      [&](const auto& stack) -> std::optional<PageOrder> {
        const int pages = stack.grid().count();
        const int views = pages / kChannels;
        const bool may_be = stack.channels() == 1 && pages % kChannels == 0;
        if (!may_be || views < kFewestListedPages) return std::nullopt;
        for (const PageOrder& order : {PageOrder{kChannels, 1}, PageOrder{kChannels, views}}) {
          if (are_channels(samples, order, views)) return order;
        }
        return std::nullopt;
      },
      samples);
}

/// Puts pictures, grey and 1×N, together to colored ones: two channels become red and green, of
/// more than three the first three are kept.
void join_channel_pages(LightField::Samples& samples, const PageOrder& order) {
  std::visit([&](auto& stack) { stack = joined_channels(stack, order); }, samples);
}

namespace fs = std::filesystem;

constexpr int kMostPictures = 1000;
constexpr int kFewestPages = 3;  ///< Two may be a picture and its thumbnail.

bool has_tiff_name(const fs::path& path) {
  const std::string suffix = suffix_of(path);
  return suffix == ".tif" || suffix == ".tiff";
}

/// Pages of ImageJ without directories; nothing for other files.
std::vector<AnyImage> read_imagej_pages(const fs::path& path);

bool has_pages(const fs::path& path) {
  return has_tiff_name(path) && count_tiff_pages(path, kMostPictures) >= kFewestPages;
}

bool is_film(const fs::path& path) {
  return is_film_name(path) || is_animated_png(path);
}

fs::path find_frames(const fs::path& path, const OpenOptions& options) {
  if (options.mosaic != Mosaic::Auto || options.lenslet > 0) return {};
  if (!fs::is_directory(path)) return has_pages(path) || is_film(path) ? path : fs::path();
  const std::vector<fs::path> images = list_images(path);
  const bool is_one =
      images.size() == 1 && (has_pages(images.front()) || is_animated_png(images.front()));
  return is_one ? images.front() : fs::path();
}

/// The pictures of a file, and what it is.
struct Frames {
  std::vector<AnyImage> pictures;
  std::string what;  ///< "pages", "pictures of a film (h264)".
};

Frames read_frames(const fs::path& path, const Progress& progress) {
  if (!has_tiff_name(path)) {
    Film film = read_film(path, kMostPictures, progress);
    return {std::move(film.pictures), "pictures of a film (" + film.codec + ")"};
  }
  const int pages = count_tiff_pages(path, kMostPictures);
  if (pages > kMostPictures) {
    throw IoError(path, fmt::format("the file has more than {} pages, which are too many for views",
                                    kMostPictures));
  }
  const ImageHeader header = read_image_header(path);
  require_view_memory(path, 8.0 * header.height * header.width * header.channels * pages);
  std::vector<AnyImage> pictures = read_imagej_pages(path);
  if (pictures.empty()) pictures = decode_pages(path, pages);
  return {std::move(pictures), "pages of a TIFF file"};
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

/// Pages that are channels of a view, as the file says or as they look.
void join_channels(LightField::Samples& samples, const std::optional<StatedPages>& stated,
                   std::string& reason, std::vector<std::string>& warnings) {
  const bool is_grey = std::visit([](const auto& stack) { return stack.channels() == 1; }, samples);
  if (is_grey && stated && stated->order.channels > 1) {
    const int channels = stated->order.channels;
    join_channel_pages(samples, stated->order);
    reason += fmt::format(", each {} of them the channels of a view, as {} wrote", channels,
                          stated->program);
    if (channels == 2) reason += ", shown as red and green";
    if (channels > 3) {
      warnings.push_back(fmt::format(finding_text("views.channels"), channels));
    }
  } else if (const auto found = find_channel_pages(samples)) {
    join_channel_pages(samples, *found);
    reason += ", each three of them the channels of a view";
  }
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
  frames.pictures.clear();
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
  parts.expected.reason = "the pictures of a file do not say how they are ordered";
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

namespace {

using Json = nlohmann::json;

constexpr int kMostChannels = 4;

struct PageAxis {
  int length = 1;
  bool is_channels = false;
};
/// The slowest first.
using PageAxes = std::vector<PageAxis>;

/// The number behind the first `name`; 1 if there is none.
int number_behind(std::string_view text, std::string_view name) {
  const auto found = text.find(name);
  int number = 1;
  if (found != std::string_view::npos) {
    const std::string_view rest = text.substr(found + name.size());
    std::from_chars(rest.data(), rest.data() + rest.size(), number);
  }
  return number;
}

PageAxes axes_of_imagej(std::string_view text) {
  return {{number_behind(text, "\nframes=")},
          {number_behind(text, "\nslices=")},
          {number_behind(text, "\nchannels="), true}};
}

PageAxes axes_of_ome(std::string_view text) {
  constexpr std::string_view kOrder = "DimensionOrder=\"XY";
  const auto found = text.find(kOrder);
  if (found == std::string_view::npos) return {};
  const std::string_view letters = text.substr(found + kOrder.size(), 3);
  PageAxes axes;
  for (const char letter : letters) {  // the fastest first
    const std::string name = std::string(" Size") + letter + "=\"";
    axes.insert(axes.begin(), {number_behind(text, name), letter == 'C'});
  }
  return axes;
}

/// Axes of a shape before the axes of a page.
PageAxes axes_of_shape(const std::vector<int>& shape, const std::string& letters, int pages) {
  PageAxes axes;
  std::int64_t product = 1;
  for (std::size_t i = 0; i < shape.size() && product < pages; ++i) {
    const bool is_named = letters.size() == shape.size() && letters[i] == 'C';
    axes.push_back({shape[i], is_named});
    product *= shape[i];
  }
  const bool has_channels = std::ranges::any_of(axes, &PageAxis::is_channels);
  if (axes.size() == 3 && !has_channels) {
    const bool is_last = axes.back().length <= kMostChannels;
    (is_last ? axes.back() : axes.front()).is_channels = true;
  }
  return axes;
}

PageAxes axes_of_tifffile(const std::string& text, int pages) {
  try {
    const auto json = parse_json<Json>(text);
    std::vector<int> shape;
    for (const Json& length : json.at("shape")) {
      shape.push_back(int_of(length));
      if (shape.back() < 1) return {};
    }
    return axes_of_shape(shape, json.value("axes", std::string()), pages);
  } catch (const Json::exception&) {
    return {};
  } catch (const InvalidInput&) {
    return {};
  }
}

std::int64_t product_of(const PageAxes& axes) {
  constexpr std::int64_t kMany = 1 << 20;
  std::int64_t product = 1;
  for (const PageAxis& axis : axes) product = std::min(kMany, product * std::max(0, axis.length));
  return product;
}

std::optional<StatedPages> pages_of(PageAxes axes, std::string program, int pages) {
  std::erase_if(axes, [](const PageAxis& axis) { return axis.length == 1; });
  // tifffile writes the last axis before that of rows as channels for ImageJ, whatever it is.
  for (PageAxis& axis : axes) axis.is_channels = axis.is_channels && axis.length <= kMostChannels;
  const auto drop_channels = [](PageAxes& from) { std::erase_if(from, &PageAxis::is_channels); };
  PageAxes of_views = axes;
  drop_channels(of_views);
  // Pages may be colored: then their channels are no axis of pages.
  if (product_of(of_views) == pages) axes = of_views;
  if (axes.empty() || product_of(axes) != pages) return std::nullopt;
  StatedPages stated;
  stated.program = std::move(program);
  const auto channels = std::ranges::find_if(axes, &PageAxis::is_channels);
  if (channels != axes.end()) {
    stated.order.channels = channels->length;
    for (auto axis = channels + 1; axis != axes.end(); ++axis) {
      stated.order.views_in_turn *= axis->length;
    }
  }
  if (of_views.size() == 2) stated.grid = GridShape{of_views[0].length, of_views[1].length};
  return stated;
}

}  // namespace

std::optional<StatedPages> stated_pages(const std::string& description, int pages) {
  if (description.starts_with("ImageJ=")) {
    return pages_of(axes_of_imagej(description), "ImageJ", pages);
  }
  if (description.find("<OME") != std::string::npos) {
    return pages_of(axes_of_ome(description), "OME-TIFF", pages);
  }
  if (description.starts_with('{')) {
    return pages_of(axes_of_tifffile(description, pages), "tifffile", pages);
  }
  return std::nullopt;
}

namespace {

/// Unsigned numbers of a file, in its byte order.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& path) : in_(path, std::ios::binary) {
    std::string begin(4, '\0');
    in_.read(begin.data(), 4);
    is_little_endian_ = begin.starts_with("II");
    is_big_ = begin == std::string("II+\0", 4) || begin == std::string("MM\0+", 4);
    const bool is_plain = begin == std::string("II*\0", 4) || begin == std::string("MM\0*", 4);
    is_tiff_ = in_ && (is_plain || is_big_);
  }

  [[nodiscard]] bool is_tiff() const { return is_tiff_; }
  [[nodiscard]] bool is_little_endian() const { return is_little_endian_; }

  /// How long places, numbers of entries, and entries are.
  [[nodiscard]] std::uint64_t place_bytes() const { return is_big_ ? 8 : 4; }
  [[nodiscard]] std::uint64_t count_bytes() const { return is_big_ ? 8 : 2; }
  [[nodiscard]] std::uint64_t entry_bytes() const { return is_big_ ? 20 : 12; }

  [[nodiscard]] std::uint64_t place_of_first_page() { return at(is_big_ ? 8 : 4, place_bytes()); }

  [[nodiscard]] std::string text(std::uint64_t place, std::uint64_t bytes) {
    std::string read(static_cast<std::size_t>(bytes), '\0');
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(place));
    in_.read(read.data(), static_cast<std::streamsize>(bytes));
    read.resize(static_cast<std::size_t>(in_.gcount()));
    return read;
  }

  /// 0 behind the end.
  [[nodiscard]] std::uint64_t at(std::uint64_t place, std::uint64_t bytes) {
    std::array<unsigned char, 8> read{};
    in_.clear();
    in_.seekg(static_cast<std::streamoff>(place));
    if (!in_.read(reinterpret_cast<char*>(read.data()), static_cast<std::streamsize>(bytes))) {
      return 0;
    }
    std::uint64_t number = 0;
    for (std::uint64_t i = 0; i < bytes; ++i) {
      number = number << 8 | read[is_little_endian_ ? bytes - 1 - i : i];
    }
    return number;
  }

 private:
  std::ifstream in_;
  bool is_little_endian_ = false;
  bool is_big_ = false;
  bool is_tiff_ = false;
};

int count_directories(const std::filesystem::path& path, int most) {
  Numbers file(path);
  if (!file.is_tiff()) return 0;
  int pages = 0;
  // Directories that lead back to themselves end at `most`.
  std::uint64_t place = file.place_of_first_page();
  for (; place != 0 && pages <= most; ++pages) {
    const std::uint64_t entries = file.at(place, file.count_bytes());
    if (entries == 0) return 0;
    place = file.at(place + file.count_bytes() + file.entry_bytes() * entries, file.place_bytes());
  }
  return pages;
}

/// Value of a tag of the first page.
struct TagValue {
  std::uint64_t place = 0;   ///< Where the first value lies,
  std::uint64_t bytes = 0;   ///< and how many bytes all have.
  std::uint64_t number = 0;  ///< The first, if it is a whole number.
};

std::optional<TagValue> tag_of(Numbers& file, std::uint64_t tag) {
  constexpr std::uint64_t kMostEntries = 1000;
  constexpr std::array<std::uint64_t, 6> kSizes{0, 1, 1, 2, 4, 8};  // of types
  if (!file.is_tiff()) return std::nullopt;
  std::uint64_t entry = file.place_of_first_page();
  const std::uint64_t entries = std::min(kMostEntries, file.at(entry, file.count_bytes()));
  entry += file.count_bytes();
  for (std::uint64_t i = 0; i < entries; ++i, entry += file.entry_bytes()) {
    if (file.at(entry, 2) != tag) continue;
    const std::uint64_t type = file.at(entry + 2, 2);
    const std::uint64_t size = type < kSizes.size() ? kSizes[type] : 8;
    TagValue value{entry + 4 + file.place_bytes(), size * file.at(entry + 4, file.place_bytes())};
    if (value.bytes > file.place_bytes()) value.place = file.at(value.place, file.place_bytes());
    value.number = file.at(value.place, size);
    return value;
  }
  return std::nullopt;
}

/// Samples that follow each other without directories.
struct RawPages {
  int count = 0;
  int height = 0, width = 0, channels = 1;
  std::uint64_t bits = 8;
  bool is_float = false;
  std::uint64_t place = 0;

  [[nodiscard]] std::uint64_t bytes() const {
    return static_cast<std::uint64_t>(height) * static_cast<std::uint64_t>(width) *
           static_cast<std::uint64_t>(channels) * bits / 8;
  }
};

/// Nothing if the file does not hold what its description states, or has them packed.
std::optional<RawPages> raw_pages_of(const std::filesystem::path& path) {
  constexpr std::uint64_t kLongest = 1 << 20;
  const std::string text = tiff_description(path);
  RawPages pages{.count = number_behind(text, "\nimages=")};
  if (!text.starts_with("ImageJ=") || pages.count < 2) return std::nullopt;
  Numbers file(path);
  const auto number = [&](std::uint64_t tag, std::uint64_t otherwise) {
    const auto value = tag_of(file, tag);
    return value ? value->number : otherwise;
  };
  const std::uint64_t width = number(256, 0), height = number(257, 0), channels = number(277, 1);
  pages.bits = number(258, 1);
  pages.is_float = number(339, 1) == 3;
  pages.place = number(273, 0);
  const bool is_known = pages.is_float ? pages.bits == 32 : pages.bits == 8 || pages.bits == 16;
  const bool is_plain = number(259, 1) == 1 && number(284, 1) == 1 && is_known &&
                        (channels == 1 || channels == 3) && std::max(width, height) <= kLongest;
  if (!is_plain) return std::nullopt;
  pages.width = static_cast<int>(width);
  pages.height = static_cast<int>(height);
  pages.channels = static_cast<int>(channels);
  const std::uint64_t bytes = pages.bytes(), size = std::filesystem::file_size(path);
  const bool is_there = bytes > 0 && pages.place <= size &&
                        static_cast<std::uint64_t>(pages.count) <= (size - pages.place) / bytes;
  return is_there ? std::optional(pages) : std::nullopt;
}

template <class T>
Image<T> raw_page(Numbers& file, const RawPages& pages, std::uint64_t place) {
  const std::string bytes = file.text(place, pages.bytes());
  Image<T> image(pages.height, pages.width, pages.channels);
  std::memcpy(image.data(), bytes.data(), std::min<std::size_t>(bytes.size(), pages.bytes()));
  if (file.is_little_endian() == (std::endian::native == std::endian::little)) return image;
  for (T& sample : image) {
    auto* const begin = reinterpret_cast<unsigned char*>(&sample);
    std::reverse(begin, begin + sizeof(T));
  }
  return image;
}

std::vector<AnyImage> read_imagej_pages(const std::filesystem::path& path) {
  std::vector<AnyImage> read;
  const auto pages = count_directories(path, 1) == 1 ? raw_pages_of(path) : std::nullopt;
  if (!pages) return read;
  Numbers file(path);
  for (int i = 0; i < pages->count; ++i) {
    const std::uint64_t place = pages->place + static_cast<std::uint64_t>(i) * pages->bytes();
    if (pages->is_float) read.emplace_back(raw_page<float>(file, *pages, place));
    if (pages->bits == 8) read.emplace_back(raw_page<std::uint8_t>(file, *pages, place));
    if (pages->bits == 16) read.emplace_back(raw_page<std::uint16_t>(file, *pages, place));
  }
  return read;
}

}  // namespace

int count_tiff_pages(const std::filesystem::path& path, int most) {
  const int directories = count_directories(path, most);
  const auto raw = directories == 1 ? raw_pages_of(path) : std::nullopt;
  return raw ? std::min(raw->count, most + 1) : directories;
}

std::string tiff_description(const std::filesystem::path& path) {
  constexpr std::uint64_t kDescription = 270;
  constexpr std::uint64_t kMostBytes = 64 << 10;
  Numbers file(path);
  const auto value = tag_of(file, kDescription);
  if (!value) return {};
  std::string text = file.text(value->place, std::min(value->bytes, kMostBytes));
  return text.substr(0, text.find('\0'));
}

}  // namespace episcope::io
