// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/find_mosaic.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/image_size.h"
#include "engine/io/mosaic/mosaic_dataset.h"
#include "engine/io/mosaic/mosaic_name.h"
#include "engine/io/open/reader.h"
#include "engine/io/open/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Beside so many images a mosaic is a by-product, as one made from a folder of views.
constexpr std::size_t kMostOthers = 3;
/// As many headers are read before an image counts as one among many.
constexpr std::size_t kMostSiblings = 64;

bool wants_mosaic(const OpenOptions& options) {
  return options.mosaic != Mosaic::Auto || options.lenslet > 0;
}

/// Whether a folder is a light field of another form. Any image makes its folder a grid of images:
/// that counts only if the views are in a folder inside.
bool is_other_form(const fs::path& folder, const OpenOptions& options) {
  if (views_folder(folder) != folder) return true;
  return std::ranges::any_of(readers(), [&](const Reader& reader) {
    const std::string_view id = reader.id;
    return id != "mosaic" && id != "sequence" && id != "image_grid" &&
           !reader.find(folder, options).empty();
  });
}

/// Whether an image is larger than all others of its folder.
bool is_largest(const fs::path& path, const std::vector<fs::path>& images) {
  if (images.size() == 1) return true;
  const auto size = image_size(path);
  if (!size || images.size() > kMostSiblings) return false;
  return std::ranges::all_of(images, [&](const fs::path& other) {
    if (other.filename() == path.filename()) return true;
    const auto its = image_size(other);
    return its && its->area() < size->area();
  });
}

fs::path find_by_file(const fs::path& path, const OpenOptions& options) {
  if (!is_image_name(path)) return find_mosaic_dataset(path, options) ? path : fs::path();
  if (wants_mosaic(options) || mosaic_name(path) != MosaicName::Plain) return path;
  const fs::path folder = scene_folder(path);
  if (!is_largest(path, list_images(folder)) || is_other_form(folder, options)) return {};
  return path;
}

fs::path find_in_folder(const fs::path& folder, const OpenOptions& options) {
  const std::vector<fs::path> images = list_images(folder);
  std::vector<fs::path> found;
  std::ranges::copy_if(images, std::back_inserter(found), [](const fs::path& image) {
    return mosaic_name(image) != MosaicName::Plain;
  });
  const bool is_asked = wants_mosaic(options);
  if (found.empty() && (is_asked || images.size() == 1)) found = images;
  if (found.empty()) return {};
  const std::size_t others = images.size() - found.size();
  if (!is_asked && (others > kMostOthers * found.size() || is_other_form(folder, options))) {
    return {};
  }
  if (found.size() == 1) return found.front();
  throw IoError(
      folder, fmt::format("the folder holds {} light fields, each in one image ({}, {}{}); "
                          "open one of them, or list them with episcope-cli list",
                          found.size(), found[0].filename().string(), found[1].filename().string(),
                          found.size() > 2 ? ", …" : ""));
}

}  // namespace

fs::path find_mosaic(const fs::path& path, const OpenOptions& options) {
  if (wants_image_grid(options)) return {};
  return fs::is_directory(path) ? find_in_folder(path, options) : find_by_file(path, options);
}

bool is_only_mosaic(const fs::path& picture) {
  const std::vector<fs::path> images = list_images(scene_folder(picture));
  return std::ranges::all_of(images, [&](const fs::path& other) {
    return other.filename() == picture.filename() || mosaic_name(other) == MosaicName::Plain;
  });
}

}  // namespace episcope::io
