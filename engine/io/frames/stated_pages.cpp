// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/frames/stated_pages.h"

#include "engine/core/error.h"
#include "engine/io/json/bounded_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

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

/// Of a shape, the axes before those of a page.
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
  // Pages may be coloured: then their channels are no axis of pages.
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

}  // namespace episcope::io
