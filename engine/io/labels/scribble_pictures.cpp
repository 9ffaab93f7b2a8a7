// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/labels/scribble_pictures.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <regex>
#include <string>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr int kRgba = 4;

std::string stem_of(ViewIndex view) {
  return fmt::format("scribbles_{:02}_{:02}", view.v, view.u);
}

std::optional<ViewIndex> view_of(const std::string& name) {
  static const std::regex pattern("scribbles_([0-9]{2,5})_([0-9]{2,5})\\.png");
  std::smatch found;
  if (!std::regex_match(name, found, pattern)) return std::nullopt;
  return ViewIndex{std::stoi(found[1]), std::stoi(found[2])};
}

template <class T>
void write_ids(const fs::path& path, const Image<std::int32_t>& labels) {
  Image<T> ids(labels.height(), labels.width());
  std::ranges::transform(labels, ids.begin(), [](std::int32_t id) { return static_cast<T>(id); });
  write_png(path, ids.view());
}

Image<std::uint8_t> preview(const Image<std::int32_t>& labels,
                            const std::vector<LabelInfo>& known) {
  Image<std::uint8_t> picture(labels.height(), labels.width(), kRgba);
  std::uint8_t* pixel = picture.data();
  for (const std::int32_t id : labels) {
    if (id > 0) {
      const auto label = std::ranges::find(known, id, &LabelInfo::id);
      const Rgb color = label == known.end() ? label_color(id) : label->color;
      std::ranges::copy(color, pixel);
      pixel[kRgba - 1] = 255;
    }
    pixel += kRgba;
  }
  return picture;
}

ViewIndex require_view(const fs::path& path, ViewIndex view, GridShape grid) {
  if (grid.contains(view)) return view;
  throw IoError(path, "the light field has no view (" + view_text(view) +
                          "); choose pictures of this light field");
}

ViewScribbles read_picture(const fs::path& path, ViewIndex view, const PixelIndex& size) {
  ViewScribbles one{view, decode_numbers(path)};
  if (one.labels.height() == size.y && one.labels.width() == size.x) return one;
  throw IoError(
      path,
      fmt::format(
          "the picture has {}×{} px, but views have {}×{} px; choose pictures of this light field",
          one.labels.height(), one.labels.width(), size.y, size.x));
}

}  // namespace

std::vector<fs::path> write_scribble_pictures(const fs::path& folder, const Scribbles& scribbles) {
  std::vector<fs::path> written;
  for (const auto& [view, labels] : scribbles.views) {
    const std::string stem = stem_of(view);
    written.push_back(folder / (stem + ".png"));
    const bool fits_byte = std::ranges::all_of(labels, [](std::int32_t id) { return id <= 255; });
    if (fits_byte) {
      write_ids<std::uint8_t>(written.back(), labels);
    } else {
      write_ids<std::uint16_t>(written.back(), labels);
    }
    written.push_back(folder / (stem + "_preview.png"));
    write_png(written.back(), preview(labels, scribbles.labels).view());
  }
  return written;
}

bool holds_scribble_pictures(const fs::path& path) {
  constexpr std::array kSuffixes{".png", ".bmp", ".tif", ".tiff", ".pgm"};
  std::error_code ignored;
  return fs::is_directory(path, ignored) ||
         std::ranges::find(kSuffixes, suffix_of(path)) != kSuffixes.end();
}

Scribbles read_scribble_pictures(const fs::path& path, GridShape grid, int height, int width) {
  std::error_code error;
  Scribbles scribbles;
  if (!fs::is_directory(path, error)) {
    const ViewIndex view = view_of(path.filename().string()).value_or(grid.center());
    scribbles.views.push_back(read_picture(path, require_view(path, view, grid), {height, width}));
    return scribbles;
  }
  const fs::path& folder = path;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto view = view_of(entry.path().filename().string());
    if (!view) continue;
    scribbles.views.push_back(
        read_picture(entry.path(), require_view(entry.path(), *view, grid), {height, width}));
  }
  if (error) throw IoError(folder, "the folder cannot be read; check its permissions");
  if (scribbles.empty()) {
    throw IoError(folder, "there is no picture scribbles_<v>_<u>.png here; choose another folder");
  }
  std::ranges::sort(scribbles.views, {},
                    [](const ViewScribbles& one) { return std::pair(one.view.v, one.view.u); });
  return scribbles;
}

}  // namespace episcope::io
