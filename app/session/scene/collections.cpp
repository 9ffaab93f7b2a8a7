// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scene/collections.h"

#include "app/session/scene/load_scene.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/io/open/scene_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

namespace episcope {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostKept = 32;

fs::path cache_file(const fs::path& folder, const fs::path& cache_folder) {
  if (cache_folder.empty()) return {};
  Fnv1a hash;
  hash.add(fs::weakly_canonical(folder).string());
  return cache_folder / "collections" / (hash_digits(hash.value()) + ".json");
}

/// Removes the files that were written longest ago.
void bound(const fs::path& folder) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> files;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    files.emplace_back(entry.last_write_time(error), entry.path());
  }
  std::ranges::sort(files);
  for (std::size_t i = 0; i + kMostKept < files.size(); ++i) fs::remove(files[i].second, error);
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

std::vector<io::CollectionEntry> list_collection(const fs::path& folder,
                                                 const fs::path& cache_folder,
                                                 const OnEntry& on_entry,
                                                 const Progress& progress) {
  const io::CollectionOptions options{.cache_file = cache_file(folder, cache_folder),
                                      .on_entry = on_entry};
  std::vector<io::CollectionEntry> entries = io::find_light_fields(folder, options, progress);
  if (!cache_folder.empty()) bound(cache_folder / "collections");
  return entries;
}

std::vector<io::CollectionEntry> collection_at(const std::string& input,
                                               const io::OpenOptions& options,
                                               const fs::path& cache_folder,
                                               const Progress& progress) {
  std::error_code error;
  const bool may_be_one = builtin_scene_id(input).empty() && !io::wants_image_grid(options) &&
                          fs::is_directory(input, error);
  if (!may_be_one) return {};
  std::vector<io::CollectionEntry> entries =
      list_collection(input, cache_folder, nullptr, progress);
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

}  // namespace episcope
