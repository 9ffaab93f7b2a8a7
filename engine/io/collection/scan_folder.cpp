// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/collection/scan_folder.h"

#include "engine/core/error.h"
#include "engine/core/hash/fnv1a.h"
#include "engine/core/text/suffix.h"
#include "engine/io/grid/decode_image.h"
#include "engine/io/grid/image_list.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/open/reader.h"
#include "engine/io/open/scene_name.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kImageGrid = "image_grid";
/// Fewer pictures than the smallest square grid are no light field that went wrong.
constexpr std::size_t kFewestViews = 4;
constexpr std::size_t kMostKinds = 16;

bool is_array_name(const fs::path& path) {
  constexpr std::array suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

std::optional<ResultBeside> result_in(const fs::path& path) {
  if (!has_hdf5_signature(path)) return std::nullopt;
  try {
    const Hdf5Input file(path);
    if (!file.has("estimate")) return std::nullopt;
    return ResultBeside{path, file.text("estimate", "method").value_or(""),
                        file.text("estimate", "source").value_or("")};
  } catch (const IoError&) {
    return std::nullopt;  // damaged: an entry with a problem
  }
}

CollectionEntry entry_at(const fs::path& path, const FolderListing& files) {
  CollectionEntry entry{.path = path,
                        .name = scene_name(path),
                        .reader = {},
                        .probe = {},
                        .fingerprint = files.fingerprint};
  for (const ListedFile& file : files.files) {
    entry.bytes += file.bytes;
    entry.modified = std::max(entry.modified, file.modified_ns / 1'000'000'000);
  }
  return entry;
}

/// Completes an entry by what its headers tell, or by why they cannot be read. Throws NoLightField.
void probe(const FoundReader& found, CollectionEntry& entry) {
  entry.reader = found.reader->id;
  if (!found.reader->probe) return;
  try {
    entry.probe = found.reader->probe(found.path, {});
  } catch (const NoLightField&) {
    throw;
  } catch (const Error& error) {
    entry.problem = error.what();
  }
}

/// What images of one origin share: "_eslf.png" of "bikes_eslf.png", ".png" of "4_07.png".
std::string image_kind(const fs::path& path) {
  const std::string name = path.filename().string();
  const std::size_t mark = path.stem().string().rfind('_');
  std::string kind = mark == std::string::npos ? suffix_of(path) : name.substr(mark);
  std::erase_if(kind, is_digit);
  return kind;
}

/// The images that are light fields each. One of every kind is tried, since trying all the views of
/// a grid would take long.
std::vector<CollectionEntry> image_entries(const FolderListing& listing) {
  std::map<std::string, std::vector<const ListedFile*>> kinds;
  for (const ListedFile& file : listing.files) {
    if (is_image_name(file.path)) kinds[image_kind(file.path)].push_back(&file);
  }
  std::vector<CollectionEntry> entries;
  if (kinds.size() > kMostKinds) return entries;
  for (const auto& [kind, files] : kinds) {
    if (!scan_file(files.front()->path)) continue;
    for (const ListedFile* file : files) {
      if (auto entry = scan_file(file->path)) entries.push_back(std::move(*entry));
    }
  }
  return entries;
}

void add_array_entries(const FolderListing& listing, FolderRecord& record) {
  for (const ListedFile& file : listing.files) {
    const bool is_result =
        std::ranges::find(record.results, file.path, &ResultBeside::path) != record.results.end();
    if (is_result || !is_array_name(file.path)) continue;
    auto entry = scan_file(file.path);
    if (!entry) continue;
    if (file.path.filename() == "lf.h5") {  // opened by its folder, with what lies beside it
      CollectionEntry whole = entry_at(listing.folder, listing);
      whole.reader = entry->reader;
      whole.probe = entry->probe;
      whole.problem = entry->problem;
      entry = std::move(whole);
      record.descends = false;
    }
    record.entries.push_back(std::move(*entry));
  }
}

/// The entry of a folder that is a light field as a whole.
CollectionEntry folder_entry(const FolderListing& listing, const FoundReader& found) {
  CollectionEntry entry = entry_at(listing.folder, listing);
  if (const fs::path views_inside = views_folder(listing.folder); views_inside != listing.folder) {
    const FolderListing inside = list_folder(views_inside);
    const CollectionEntry views = entry_at(views_inside, inside);
    entry.bytes += views.bytes;
    entry.modified = std::max(entry.modified, views.modified);
    Fnv1a both;
    both.add_word(listing.fingerprint);
    both.add_word(inside.fingerprint);
    entry.fingerprint = both.value();
  }
  probe(found, entry);
  return entry;
}

FoundReader reader_of_folder(const fs::path& folder) {
  try {
    return find_reader(folder, {});
  } catch (const Error&) {
    return {};  // by a damaged file, which is an entry of its own
  }
}

/// Whether the views lie in a folder inside that is an entry of its own.
bool is_around(const fs::path& folder) {
  return named_views_folder(folder) == folder && views_folder(folder) != folder;
}

std::size_t image_count(const FolderListing& listing) {
  return static_cast<std::size_t>(std::ranges::count_if(
      listing.files, [](const ListedFile& file) { return is_image_name(file.path); }));
}

/// Any folder of pictures may be taken for a grid of views; but not one whose views lie in several
/// folders inside, which are none of their own.
void add_image_grid(const FolderListing& listing, CollectionEntry entry, FolderRecord& record) {
  const bool is_inside = views_folder(listing.folder) != listing.folder;
  const bool is_of_folders = entry.problem.empty() && !is_inside && image_count(listing) == 0;
  record.is_doubtful = !is_of_folders;
  record.descends = !is_of_folders;
  const bool is_counted =
      entry.problem.empty() || is_inside || image_count(listing) >= kFewestViews;
  if (is_counted) record.entries.push_back(std::move(entry));
}

}  // namespace

std::optional<CollectionEntry> scan_file(const fs::path& file) {
  CollectionEntry entry = entry_at(file, list_file(file));
  try {
    const FoundReader found = find_reader(file, {});
    if (!found.reader || found.path != file) return std::nullopt;
    probe(found, entry);
  } catch (const NoLightField&) {
    return std::nullopt;
  } catch (const Error& error) {
    entry.problem = error.what();
  }
  return entry;
}

FolderRecord scan_folder(const FolderListing& listing) {
  FolderRecord record;
  for (const ListedFile& file : listing.files) {
    if (auto result = result_in(file.path)) record.results.push_back(std::move(*result));
  }
  const FoundReader found = reader_of_folder(listing.folder);
  const std::string_view id = found.reader ? found.reader->id : "";
  const bool is_folder =
      found.reader && fs::is_directory(found.path) && !(id == kImageGrid && is_around(found.path));
  if (is_folder && id != kImageGrid) {
    record.descends = false;
    record.entries.push_back(folder_entry(listing, found));
    return record;
  }
  record.entries = image_entries(listing);
  if (record.entries.empty() && is_folder) {
    add_image_grid(listing, folder_entry(listing, found), record);
    return record;
  }
  add_array_entries(listing, record);
  return record;
}

}  // namespace episcope::io
