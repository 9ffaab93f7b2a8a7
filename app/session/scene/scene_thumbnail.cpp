// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/scene_thumbnail.h"

#include "engine/core/error.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/image_file.h"
#include "engine/io/open/open.h"
#include "engine/render/fit.h"

#include <algorithm>
#include <optional>
#include <stop_token>
#include <system_error>
#include <utility>
#include <vector>

namespace episcope {
namespace {

namespace fs = std::filesystem;
using Picture = Image<std::uint8_t>;

constexpr std::size_t kMostKept = 4000;

fs::path cache_file(const io::CollectionEntry& entry, const fs::path& cache_folder) {
  if (cache_folder.empty()) return {};
  Fnv1a hash;
  std::error_code error;
  hash.add(fs::weakly_canonical(entry.path, error).string());
  hash.add_word(entry.fingerprint);
  return cache_folder / "thumbnails" / (hash_digits(hash.value()) + ".png");
}

/// Half of the files, those made longest ago, once there are too many.
void bound(const fs::path& folder) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    files.emplace_back(entry.last_write_time(error), entry.path());
  }
  if (files.size() <= kMostKept) return;
  std::ranges::sort(files);
  for (std::size_t i = 0; i < kMostKept / 2; ++i) fs::remove(files[i].second, error);
}

std::optional<Picture> kept(const fs::path& file) {
  std::error_code error;
  if (file.empty() || !fs::exists(file, error)) return std::nullopt;
  try {
    io::AnyImage decoded = io::decode_image(file);
    auto* picture = std::get_if<Picture>(&decoded);
    const bool is_ours = picture && picture->channels() == 3 &&
                         picture->width() <= kThumbnailSide && picture->height() <= kThumbnailSide;
    return is_ours ? std::optional(std::move(*picture)) : std::nullopt;
  } catch (const IoError&) {
    return std::nullopt;  // damaged
  }
}

void keep(const fs::path& file, const Picture& picture) {
  if (file.empty()) return;
  try {
    fs::create_directories(file.parent_path());
    io::write_png(file, picture.view());
    bound(file.parent_path());
  } catch (const std::exception&) {
    return;  // a cache is a convenience
  }
}

/// Reading ends as soon as the centre view is there.
Picture center_view(const fs::path& path, const Progress& progress) {
  Picture center;
  std::stop_source enough;
  io::OpenOptions options;
  options.needs_truth = false;
  options.on_center_view = [&](const Picture& rgb, const LightFieldInfo&, GridShape) {
    center = rgb;
    enough.request_stop();
  };
  const auto pass_on = [&](const ProgressState&) {
    if (progress.stop_requested()) enough.request_stop();
  };
  try {
    (void)io::open_scene(path, options, Progress(enough.get_token(), pass_on, 1));
  } catch (const Cancelled&) {
    progress.check();
  }
  if (center.empty()) throw IoError(path, "it has no centre view to show");
  return center;
}

}  // namespace

Image<std::uint8_t> scene_thumbnail(const io::CollectionEntry& entry, const fs::path& cache_folder,
                                    const Progress& progress) {
  const fs::path file = cache_file(entry, cache_folder);
  if (auto picture = kept(file)) return std::move(*picture);
  Picture picture = render::fitted(center_view(entry.path, progress), kThumbnailSide);
  keep(file, picture);
  return picture;
}

}  // namespace episcope
