// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/frames_reader.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/list_grid.h"
#include "engine/io/frames/channel_pages.h"
#include "engine/io/frames/film.h"
#include "engine/io/frames/stated_pages.h"
#include "engine/io/frames/tiff_pages.h"
#include "engine/io/grid/image_header.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/maps/sample_range.h"
#include "engine/io/open/assemble_scene.h"
#include "engine/io/open/center_preview.h"
#include "engine/io/open/grid_option.h"
#include "engine/io/open/scene_name.h"
#include "engine/io/open/view_memory.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

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
  return {decode_pages(path, pages), "pages of a TIFF file"};
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
      warnings.push_back(
          fmt::format("Of {} channels of a view the first three are read, as red, "
                      "green and blue.",
                      channels));
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

constexpr const char* kOptions[] = {"flip", "grid", "crop", "levels"};

}  // namespace

Reader frames_reader() {
  return {.id = "frames",
          .name = "pages of a TIFF file, or a film",
          .options = kOptions,
          .find = find_frames,
          .read = read_light_field,
          .probe = probe_frames};
}

}  // namespace episcope::io
