// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/collections.h"

#include "app/session/load_scene.h"
#include "engine/core/hash.h"
#include "engine/io/base/files.h"
#include "engine/io/base/image_file.h"
#include "engine/io/models/reader.h"
#include "engine/io/open.h"
#include "engine/render/shade.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stop_token>
#include <system_error>
#include <utility>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostThumbnails = 4000;

/// Removes the oldest files of a folder that holds more than `most`, until `kept` are left.
void prune(const fs::path& folder, std::size_t most, std::size_t kept) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    files.emplace_back(entry.last_write_time(error), entry.path());
  }
  if (files.size() <= most) return;
  std::ranges::sort(files);
  for (std::size_t i = 0; i + kept < files.size(); ++i) fs::remove(files[i].second, error);
}

std::vector<std::string> parts_of(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  std::vector<std::string> parts;
  for (const fs::path& part : whole) {
    if (!part.empty() && part != whole.root_path()) parts.push_back(part.string());
  }
  return parts;
}

/// The name after those of `depth` folders around the scene.
std::string long_name(const io::CollectionEntry& entry, std::size_t depth) {
  std::vector<std::string> parts = parts_of(entry.path);
  if (!parts.empty()) parts.pop_back();
  std::string name = entry.name;
  for (std::size_t i = 0; i < depth && i < parts.size(); ++i) {
    name = fmt::format("{}_{}", parts[parts.size() - 1 - i], name);
  }
  return name;
}

}  // namespace

std::vector<io::CollectionEntry> collection_at(const std::string& input,
                                               const io::OpenOptions& options,
                                               const Progress& progress) {
  std::error_code error;
  const bool may_be_one = builtin_scene_id(input).empty() && !io::wants_image_grid(options) &&
                          fs::is_directory(input, error);
  if (!may_be_one) return {};
  std::vector<io::CollectionEntry> entries = io::find_light_fields(input, {}, progress);
  const auto is_itself = [&](const io::CollectionEntry& entry) {
    return fs::equivalent(entry.path, input, error);
  };
  return std::ranges::any_of(entries, is_itself) ? std::vector<io::CollectionEntry>() : entries;
}

IsCollection::IsCollection(const fs::path& folder, std::size_t count)
    : IoError(folder,
              fmt::format("this folder is not a light field but holds {}; open one of them: "
                          "'episcope-cli list {}' tells their names",
                          count == 1 ? "one" : std::to_string(count), folder.string())) {}

std::vector<std::string> unique_names(const std::vector<io::CollectionEntry>& entries) {
  constexpr std::size_t most_folders = 8;
  std::vector<std::string> names(entries.size());
  std::vector<bool> is_settled(entries.size(), false);
  for (std::size_t depth = 0; depth <= most_folders; ++depth) {
    std::map<std::string, int> counts;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (!is_settled[i]) names[i] = long_name(entries[i], depth);
      ++counts[names[i]];
    }
    for (std::size_t i = 0; i < entries.size(); ++i) is_settled[i] = counts[names[i]] == 1;
  }
  std::map<std::string, int> counts;
  for (std::string& name : names) {
    if (const int count = counts[name]++; count > 0) name = fmt::format("{}_{}", name, count + 1);
  }
  return names;
}

namespace {

using Picture = Image<std::uint8_t>;

fs::path cache_file(const io::CollectionEntry& entry, const fs::path& cache_folder) {
  if (cache_folder.empty()) return {};
  Fnv1a hash;
  std::error_code error;
  hash.add(fs::weakly_canonical(entry.path, error).string());
  hash.add_word(entry.bytes);
  hash.add_word(static_cast<std::uint64_t>(entry.modified));
  return cache_folder / "thumbnails" / (hash_digits(hash.value()) + ".png");
}

std::optional<Picture> kept(const fs::path& file) {
  if (file.empty() || !io::is_there(file)) return std::nullopt;
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
    prune(file.parent_path(), kMostThumbnails, kMostThumbnails / 2);
  } catch (const std::exception&) {
    return;  // a cache is a convenience
  }
}

/// Reading ends as soon as the center view is there.
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
  if (center.empty()) throw IoError(path, "it has no center view to show");
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
