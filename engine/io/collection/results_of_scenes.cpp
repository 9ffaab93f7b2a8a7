// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/collection/results_of_scenes.h"

#include <algorithm>
#include <map>
#include <string>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

using Places = std::map<std::string, std::vector<CollectionEntry*>>;

std::string place_of(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.string();
}

CollectionEntry* only_one(const Places& places, const std::string& place) {
  const auto found = places.find(place);
  return found != places.end() && found->second.size() == 1 ? found->second.front() : nullptr;
}

/// Entries by what names them.
struct Index {
  Places paths;
  Places folders;
  Places names;

  explicit Index(std::vector<CollectionEntry>& entries) {
    for (CollectionEntry& entry : entries) {
      const fs::path place = place_of(entry.path);
      std::error_code error;
      const bool is_folder = fs::is_directory(place, error);
      paths[place.string()].push_back(&entry);
      folders[(is_folder ? place : place.parent_path()).string()].push_back(&entry);
      names[entry.name].push_back(&entry);
    }
  }

  [[nodiscard]] CollectionEntry* named_source(const ResultBeside& result) const {
    if (result.source.empty()) return nullptr;
    const fs::path source = place_of(result.path.parent_path() / result.source);
    if (CollectionEntry* entry = only_one(paths, source.string())) return entry;
    // lf.h5 or the folder of views, for an entry that is the folder around it.
    return only_one(paths, source.parent_path().string());
  }

  /// The longest name that the result's name begins with, up to a mark.
  [[nodiscard]] CollectionEntry* namesake(const ResultBeside& result) const {
    std::string name = result.path.stem().string();
    while (!name.empty()) {
      if (CollectionEntry* entry = only_one(names, name)) return entry;
      const std::size_t mark = name.find_last_of("_-. ");
      name.resize(mark == std::string::npos ? 0 : mark);
    }
    return nullptr;
  }
};

}  // namespace

void add_results(std::vector<CollectionEntry>& entries, const std::vector<ResultBeside>& results) {
  const Index index(entries);
  for (const ResultBeside& result : results) {
    CollectionEntry* entry = index.named_source(result);
    if (!entry) entry = only_one(index.folders, place_of(result.path.parent_path()));
    if (!entry) entry = index.namesake(result);
    if (entry) entry->results.push_back(result);
  }
}

}  // namespace episcope::io
