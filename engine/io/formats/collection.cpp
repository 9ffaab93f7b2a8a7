// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/formats/collection.h"

#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/foreign_content.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/image_file.h"
#include "engine/io/base/image_header.h"
#include "engine/io/models/choose_layout.h"
#include "engine/io/models/labels/color_table.h"
#include "engine/io/models/labels/label_pictures.h"
#include "engine/io/models/mat5.h"
#include "engine/io/models/names/view_folders.h"
#include "engine/io/models/numpy_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <memory>
#include <set>
#include <utility>
#include <variant>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

using EntryPlaces = std::map<std::string, std::vector<CollectionEntry*>>;

std::string place_of(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path, error).lexically_normal();
  if (!whole.has_filename()) whole = whole.parent_path();
  return whole.string();
}

CollectionEntry* only_one(const EntryPlaces& places, const std::string& place) {
  const auto found = places.find(place);
  return found != places.end() && found->second.size() == 1 ? found->second.front() : nullptr;
}

/// Entries by what names them.
struct Index {
  EntryPlaces paths;
  EntryPlaces folders;
  EntryPlaces names;

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

  [[nodiscard]] CollectionEntry* named_source(const ListedResult& result) const {
    if (result.source.empty()) return nullptr;
    const fs::path source = place_of(result.path.parent_path() / result.source);
    if (CollectionEntry* entry = only_one(paths, source.string())) return entry;
    // lf.h5 or the folder of views, for an entry that is the folder around it.
    return only_one(paths, source.parent_path().string());
  }

  /// The longest name that the result's name begins with, up to a mark.
  [[nodiscard]] CollectionEntry* namesake(const ListedResult& result) const {
    std::string name = result.path.stem().string();
    while (!name.empty()) {
      if (CollectionEntry* entry = only_one(names, name)) return entry;
      const std::size_t mark = name.find_last_of("_-. ");
      name.resize(mark == std::string::npos ? 0 : mark);
    }
    return nullptr;
  }
};

/// Gives each result to the light field among `entries` that it names as its source; else to the
/// only one of its folder; else to the only one whose name its own begins with. Others are left
/// out.
void add_results(std::vector<CollectionEntry>& entries, const std::vector<ListedResult>& results) {
  const Index index(entries);
  for (const ListedResult& result : results) {
    CollectionEntry* entry = index.named_source(result);
    if (!entry) entry = only_one(index.folders, place_of(result.path.parent_path()));
    if (!entry) entry = index.namesake(result);
    if (entry) entry->results.push_back(result);
  }
}

/// Deeper ones are a mistake; paths end at some length anyway.
constexpr int kDeepestFolder = 64;

/// Maps of every view, in a folder inside the folder of the views, look like views.
bool are_maps_of(const CollectionEntry& inside, const CollectionEntry& views) {
  return inside.reader == views.reader && inside.probe.grid == views.probe.grid &&
         inside.probe.list == views.probe.list && inside.probe.height == views.probe.height &&
         inside.probe.width == views.probe.width;
}

class CollectionSearch {
 public:
  CollectionSearch(const OnCollectionEntry& on_entry, const Progress& progress)
      : on_entry_(on_entry), progress_(progress) {}

  void visit(const fs::path& folder, int depth) {
    progress_.check();
    if (depth > kDeepestFolder || !seen_.insert(fs::weakly_canonical(folder).string()).second)
      return;
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
    std::ranges::sort(found_, {}, &CollectionEntry::path);
    add_results(found_, results_);
    return std::move(found_);
  }

 private:
  void look_into(const fs::path& folder, int depth) {
    const FolderListing listing = list_folder(folder);
    const FolderRecord record = scan_folder(listing);
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
    if (on_entry_) on_entry_(entry);
    // They are given out again when all are known.
    entry.results.clear();
    found_.push_back(std::move(entry));
  }

  const OnCollectionEntry& on_entry_;
  Progress progress_;
  std::set<std::string> seen_;
  std::vector<CollectionEntry> found_;
  std::vector<ListedResult> results_;
};

}  // namespace

std::vector<CollectionEntry> find_light_fields(const fs::path& root,
                                               const OnCollectionEntry& on_entry,
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
  CollectionSearch search(on_entry, progress);
  search.visit(root, 0);
  return search.finish();
}

namespace {

std::int64_t nanoseconds(fs::file_time_type time) {
  const auto since_1970 = std::chrono::file_clock::to_sys(time).time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

void sort(FolderListing& listing) {
  std::ranges::sort(listing.files, {}, &ListedFile::path);
  std::ranges::sort(listing.folders);
}

void add_file(FolderListing& listing, const fs::directory_entry& entry) {
  std::error_code error;
  const std::uintmax_t bytes = entry.file_size(error);
  if (error) return;  // gone meanwhile
  const auto time = entry.last_write_time(error);
  if (!error) listing.files.push_back({entry.path(), bytes, nanoseconds(time)});
}

}  // namespace

FolderListing list_folder(const fs::path& folder) {
  FolderListing listing{.folder = folder, .files = {}, .folders = {}};
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename().string().starts_with('.')) continue;
    std::error_code error;
    if (entry.is_directory(error)) {
      listing.folders.push_back(entry.path());
    } else if (entry.is_regular_file(error)) {
      add_file(listing, entry);
    }
  }
  sort(listing);
  return listing;
}

FolderListing list_file(const fs::path& file) {
  FolderListing listing{.folder = file.parent_path(), .files = {}, .folders = {}};
  add_file(listing, fs::directory_entry(file));
  return listing;
}

namespace {

constexpr std::string_view kImageGrid = "image_grid";
/// Fewer pictures than the smallest square grid are no light field that went wrong.
constexpr std::size_t kFewestFailedViews = 4;
constexpr std::size_t kMostNameKinds = 16;

bool is_array_name(const fs::path& path) {
  constexpr std::array suffixes{".h5", ".hdf5", ".mat", ".npy", ".npz"};
  return std::ranges::find(suffixes, suffix_of(path)) != suffixes.end();
}

/// Whether all that could be a light field of a NumPy or MATLAB file is a map of gray views by its
/// name: what `estimate` writes of all views.
bool holds_maps_alone(const fs::path& path) {
  try {
    std::unique_ptr<const ArrayFile> file;
    if (is_numpy_file(path)) file = std::make_unique<const NumpyFile>(path);
    if (suffix_of(path) == ".mat") file = open_matlab_file(path);
    if (!file) return false;
    const auto is_map = [](const ArrayEntry* entry) {
      constexpr std::size_t kAxesOfMaps = 4;
      return entry->shape.size() == kAxesOfMaps && has_other_name(*entry);
    };
    const std::vector<const ArrayEntry*> fields = light_fields_of(*file, {});
    return !fields.empty() && std::ranges::all_of(fields, is_map);
  } catch (const Error&) {
    return false;  // damaged: an entry with a problem
  }
}

std::optional<ListedResult> result_in(const fs::path& path) {
  if (!has_hdf5_signature(path)) return std::nullopt;
  try {
    const Hdf5Input file(path);
    if (!file.has("estimate")) return std::nullopt;
    return ListedResult{path, file.text("estimate", "method").value_or(""),
                        file.text("estimate", "source").value_or("")};
  } catch (const IoError&) {
    return std::nullopt;  // damaged: an entry with a problem
  }
}

CollectionEntry entry_at(const fs::path& path, const FolderListing& files) {
  CollectionEntry entry{.path = path, .name = scene_name(path), .reader = {}, .probe = {}};
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

/// Not a pointer or a web page in place of one: they all fail for the same reason.
bool is_picture(const ListedFile* file) {
  return foreign_content(file->path).empty();
}

/// The images that are light fields each. One of every kind is tried, since trying, or only
/// opening, all the views of a grid would take long.
std::vector<CollectionEntry> image_entries(const FolderListing& listing) {
  std::map<std::string, std::vector<const ListedFile*>> kinds;
  for (const ListedFile& file : listing.files) {
    if (is_image_name(file.path) && file.bytes > 0) {
      kinds[image_kind(file.path)].push_back(&file);
    }
  }
  std::vector<CollectionEntry> entries;
  if (kinds.size() > kMostNameKinds) return entries;
  for (const auto& [kind, files] : kinds) {
    const auto first = std::ranges::find_if(files, is_picture);
    if (first == files.end() || !scan_file((*first)->path)) continue;
    for (const ListedFile* file : files) {
      if (!is_picture(file)) continue;
      if (auto entry = scan_file(file->path)) entries.push_back(std::move(*entry));
    }
  }
  return entries;
}

void add_array_entries(const FolderListing& listing, FolderRecord& record) {
  for (const ListedFile& file : listing.files) {
    const bool is_result =
        std::ranges::find(record.results, file.path, &ListedResult::path) != record.results.end();
    if (is_result || !is_array_name(file.path) || holds_maps_alone(file.path)) continue;
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
    const CollectionEntry views = entry_at(views_inside, list_folder(views_inside));
    entry.bytes += views.bytes;
    entry.modified = std::max(entry.modified, views.modified);
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

/// Without the pictures that this program made of maps and views: they are no views.
FolderListing without_own_pictures(FolderListing listing) {
  std::erase_if(listing.files, [](const ListedFile& file) { return is_own_picture(file.path); });
  return listing;
}

std::size_t image_count(const FolderListing& listing) {
  return static_cast<std::size_t>(std::ranges::count_if(
      listing.files, [](const ListedFile& file) { return is_image_name(file.path); }));
}

/// Of labels in the form of VOC, as `write_label_folder` and CVAT write them: its pictures are
/// drawn labels, and copies of views.
bool is_label_export(const FolderListing& listing) {
  return listing.files.size() == 1 && listing.files.front().path.filename() == kLabelMap &&
         std::ranges::find(listing.folders, listing.folder / "SegmentationClass") !=
             listing.folders.end();
}

/// Any folder of pictures may be taken for a grid of views; but not one whose views lie in several
/// folders inside, which are none of their own.
void add_image_grid(const FolderListing& listing, CollectionEntry entry, FolderRecord& record) {
  const bool is_inside = views_folder(listing.folder) != listing.folder;
  const bool is_of_folders = entry.problem.empty() && !is_inside && image_count(listing) == 0;
  record.is_doubtful = !is_of_folders;
  record.descends = !is_of_folders;
  const bool is_counted =
      entry.problem.empty() || is_inside || image_count(listing) >= kFewestFailedViews;
  if (is_counted) record.entries.push_back(std::move(entry));
}

/// Whether a picture that headers do not tell from a mosaic has so few colors that it is a drawing
/// of labels. Large ones are not looked at: views are smaller than what holds all of them.
bool is_drawing(const CollectionEntry& entry) {
  constexpr double kMostPixels = 1 << 22;
  if (!is_image_name(entry.path) || entry.probe.width > 0) return false;
  const auto header = stated_image_header(entry.path);
  if (!header || static_cast<double>(header->width) * header->height > kMostPixels) return false;
  const AnyImage image = decode_image(entry.path);
  const auto* picture = std::get_if<Image<std::uint8_t>>(&image);
  if (!picture) return false;
  std::set<std::uint32_t> colors;
  const auto channels = static_cast<std::size_t>(picture->channels());
  for (std::size_t i = 0; i < picture->size() && colors.size() <= kMostLabelColors; i += channels) {
    std::uint32_t color = 0;
    for (std::size_t c = 0; c < channels; ++c) color = color << 8 | picture->data()[i + c];
    colors.insert(color);
  }
  return colors.size() <= kMostLabelColors;
}

}  // namespace

std::optional<CollectionEntry> scan_file(const fs::path& file) {
  CollectionEntry entry = entry_at(file, list_file(file));
  try {
    const FoundReader found = find_reader(file, {});
    if (!found.reader || found.path != file) return std::nullopt;
    probe(found, entry);
    if (is_drawing(entry)) return std::nullopt;
  } catch (const NoLightField&) {
    return std::nullopt;
  } catch (const Error& error) {
    entry.problem = error.what();
  }
  return entry;
}

FolderRecord scan_folder(const FolderListing& listing) {
  FolderRecord record;
  if (is_label_export(listing)) {
    record.descends = false;
    return record;
  }
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
  const FolderListing others = without_own_pictures(listing);
  const bool has_own_alone = image_count(listing) > 0 && image_count(others) == 0;
  record.entries = image_entries(others);
  if (record.entries.empty() && is_folder && !has_own_alone) {
    add_image_grid(others, folder_entry(listing, found), record);
    return record;
  }
  add_array_entries(listing, record);
  return record;
}

}  // namespace episcope::io
