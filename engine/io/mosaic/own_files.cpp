// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/own_files.h"

#include "engine/core/text/character.h"
#include "engine/core/text/suffix.h"
#include "engine/io/beside/map_name.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/grid/image_size.h"
#include "engine/io/mosaic/find_mosaic.h"
#include "engine/io/mosaic/mosaic_name.h"
#include "engine/io/open/scene_folder.h"

#include <algorithm>

namespace episcope::io {
namespace {

/// Length of the name of the scene if the file is named after it, else 0.
std::size_t likeness(const std::string& stem, const std::string& scene) {
  if (!stem.starts_with(scene)) return 0;
  const bool is_word = stem.size() == scene.size() ||
                       !(is_letter(stem[scene.size()]) || is_digit(stem[scene.size()]));
  return is_word ? scene.size() : 0;
}

/// Whether `other` is as likely a picture of all views: by its name, or because it has the same
/// size.
bool is_alike(const std::filesystem::path& other, const std::filesystem::path& picture) {
  if (mosaic_name(other) != MosaicName::Plain) return true;
  if (map_kind(other.stem().string())) return false;
  const auto size = image_size(other), own = image_size(picture);
  return size && own && size->area() == own->area();
}

}  // namespace

OwnFiles::OwnFiles(const std::filesystem::path& picture)
    : scene_(scene_of_mosaic(picture)), is_only_(is_only_mosaic(picture)) {
  for (const std::filesystem::path& other : list_images(scene_folder(picture))) {
    if (other.filename() == picture.filename() || !is_alike(other, picture)) continue;
    others_.push_back(scene_of_mosaic(other));
  }
}

bool OwnFiles::contains(const std::filesystem::path& file) const {
  const std::string stem = lower_case(file.stem().string());
  const std::size_t own = likeness(stem, scene_);
  std::size_t of_another = 0;
  for (const std::string& other : others_) of_another = std::max(of_another, likeness(stem, other));
  return own > of_another || (is_only_ && of_another == 0);
}

}  // namespace episcope::io
