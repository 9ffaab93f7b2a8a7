// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/collection/collection.h"

#include "engine/core/error.h"
#include "engine/io/collection/collection_cache.h"
#include "engine/io/collection/results_of_scenes.h"
#include "engine/io/collection/scan_folder.h"

#include <algorithm>
#include <set>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Deeper ones are a mistake; paths end at some length anyway.
constexpr int kDeepest = 64;

/// Maps of every view, in a folder inside that of the views, look like views.
bool are_maps_of(const CollectionEntry& inside, const CollectionEntry& views) {
  return inside.reader == views.reader && inside.probe.grid == views.probe.grid &&
         inside.probe.list == views.probe.list && inside.probe.height == views.probe.height &&
         inside.probe.width == views.probe.width;
}

class Search {
 public:
  Search(const CollectionOptions& options, const Progress& progress)
      : options_(options), cache_(options.cache_file), progress_(progress) {}

  void visit(const fs::path& folder, int depth) {
    progress_.check();
    if (depth > kDeepest || !seen_.insert(fs::weakly_canonical(folder).string()).second) return;
    try {
      look_into(folder, depth);
    } catch (const fs::filesystem_error& error) {
      take({.path = folder,
            .name = folder.filename().string(),
            .reader = {},
            .probe = {},
            .problem = IoError(folder, "it cannot be read (" + error.code().message() +
                                           "); check its permissions")
                           .what()});
    }
  }

  std::vector<CollectionEntry> finish() {
    cache_.save();
    std::ranges::sort(found_, {}, &CollectionEntry::path);
    add_results(found_, results_);
    return std::move(found_);
  }

 private:
  void look_into(const fs::path& folder, int depth) {
    const FolderListing listing = list_folder(folder);
    const FolderRecord* kept = cache_.find(folder, listing.fingerprint);
    const FolderRecord record = kept ? *kept : scan_folder(listing);
    cache_.keep(folder, listing.fingerprint, record);
    results_.insert(results_.end(), record.results.begin(), record.results.end());
    const auto take_all = [&] {
      std::vector<CollectionEntry> entries = record.entries;
      add_results(entries, record.results);
      for (CollectionEntry& entry : entries) take(std::move(entry));
    };
    if (!record.is_doubtful) take_all();
    if (!record.descends) return;
    const std::size_t before = found_.size();
    for (std::size_t i = 0; i < listing.folders.size(); ++i) {
      visit(listing.folders[i], depth + 1);
      if (depth == 0) progress_.report((i + 1.0) / static_cast<double>(listing.folders.size()));
    }
    if (record.is_doubtful && settle(record, before)) take_all();
  }

  /// Whether the doubtful entries of a folder are light fields: then what was found below is none.
  bool settle(const FolderRecord& record, std::size_t before) {
    const auto below = found_.begin() + static_cast<std::ptrdiff_t>(before);
    if (below == found_.end()) return true;
    const auto are_maps = [&](const CollectionEntry& inside) {
      return std::ranges::any_of(record.entries, [&](const CollectionEntry& entry) {
        return entry.problem.empty() && (!inside.problem.empty() || are_maps_of(inside, entry));
      });
    };
    if (!std::all_of(below, found_.end(), are_maps)) return false;
    found_.erase(below, found_.end());
    return true;
  }

  void take(CollectionEntry entry) {
    if (options_.on_entry) options_.on_entry(entry);
    // They are given out again when all are known.
    entry.results.clear();
    found_.push_back(std::move(entry));
  }

  const CollectionOptions& options_;
  CollectionCache cache_;
  Progress progress_;
  std::set<std::string> seen_;
  std::vector<CollectionEntry> found_;
  std::vector<ResultBeside> results_;
};

}  // namespace

std::vector<CollectionEntry> find_light_fields(const fs::path& root,
                                               const CollectionOptions& options,
                                               const Progress& progress) {
  std::error_code error;
  if (!fs::exists(root, error)) {
    throw IoError(root, "there is no such file or folder; check the path");
  }
  if (!fs::is_directory(root, error)) {
    std::vector<CollectionEntry> entries;
    if (auto entry = scan_file(root)) entries.push_back(std::move(*entry));
    return entries;
  }
  progress.step("looking for light fields");
  Search search(options, progress);
  search.visit(root, 0);
  return search.finish();
}

}  // namespace episcope::io
