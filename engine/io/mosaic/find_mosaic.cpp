// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/find_mosaic.h"

#include "engine/core/error.h"
#include "engine/io/grid/image_size.h"
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

std::vector<fs::path> images_in(const fs::path& folder) {
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (!is_hidden && is_image_name(entry.path()) && entry.is_regular_file()) {
      images.push_back(entry.path());
    }
  }
  std::ranges::sort(images);
  return images;
}

bool wants_mosaic(const OpenOptions& options) {
  return options.mosaic != Mosaic::Auto || options.lenslet > 0;
}

/// Whether a folder is a light field of another form; a grid of images counts only if it is in a
/// folder inside, because any image makes its folder one.
bool is_other_form(const fs::path& folder, const OpenOptions& options) {
  return std::ranges::any_of(readers(), [&](const Reader& reader) {
    if (std::string_view(reader.id) == "mosaic") return false;
    const fs::path found = reader.find(folder, options);
    return !found.empty() && (std::string_view(reader.id) != "image_grid" || found != folder);
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
  if (!is_image_name(path)) return {};
  if (wants_mosaic(options) || mosaic_name(path) != MosaicName::Plain) return path;
  const fs::path folder = scene_folder(path);
  if (!is_largest(path, images_in(folder)) || is_other_form(folder, options)) return {};
  return path;
}

fs::path find_in_folder(const fs::path& folder, const OpenOptions& options) {
  const std::vector<fs::path> images = images_in(folder);
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
  const std::vector<fs::path> images = images_in(scene_folder(picture));
  return std::ranges::all_of(images, [&](const fs::path& other) {
    return other.filename() == picture.filename() || mosaic_name(other) == MosaicName::Plain;
  });
}

}  // namespace episcope::io
