// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/tiff_pages.h"

#include "engine/core/error.h"
#include "engine/io/base/json.h"
#include "engine/io/base/tiff_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

namespace episcope::io {
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
  TiffFile file(path);
  const auto number = [&](std::uint64_t tag, std::uint64_t otherwise) {
    const auto value = file.tag(tag);
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
Image<T> raw_page(TiffFile& file, const RawPages& pages, std::uint64_t place) {
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

std::vector<AnyImage> read_imagej_pages(const std::filesystem::path& path) {
  std::vector<AnyImage> read;
  TiffFile file(path);
  const auto pages = file.directories(1).size() == 1 ? raw_pages_of(path) : std::nullopt;
  if (!pages) return read;
  for (int i = 0; i < pages->count; ++i) {
    const std::uint64_t place = pages->place + static_cast<std::uint64_t>(i) * pages->bytes();
    if (pages->is_float) read.emplace_back(raw_page<float>(file, *pages, place));
    if (pages->bits == 8) read.emplace_back(raw_page<std::uint8_t>(file, *pages, place));
    if (pages->bits == 16) read.emplace_back(raw_page<std::uint16_t>(file, *pages, place));
  }
  return read;
}

int count_tiff_pages(const std::filesystem::path& path, int most) {
  const auto directories = static_cast<int>(TiffFile(path).directories(most).size());
  const auto raw = directories == 1 ? raw_pages_of(path) : std::nullopt;
  return raw ? std::min(raw->count, most + 1) : directories;
}

std::string tiff_description(const std::filesystem::path& path) {
  constexpr std::uint64_t kDescription = 270;
  constexpr std::uint64_t kMostBytes = 64 << 10;
  TiffFile file(path);
  const auto value = file.tag(kDescription);
  if (!value) return {};
  std::string text = file.text(value->place, std::min(value->bytes, kMostBytes));
  return text.substr(0, text.find('\0'));
}

}  // namespace episcope::io
