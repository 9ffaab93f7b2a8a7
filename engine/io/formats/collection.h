// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/io/models/reader.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Result file (result_file.h) and its method and light field as stored in it.
struct ListedResult {
  std::filesystem::path path;
  std::string method;
  std::string source;  ///< Its light field, as stored: absolute, or relative to the file's folder.
};

struct CollectionEntry {
  std::filesystem::path path;  ///< What opens it: a scene folder or a file.
  std::string name;            ///< For lists (scene_name).
  std::string reader;          ///< Id of its reader (reader.h); empty if that is not known.
  SceneProbe probe;
  std::vector<ListedResult> results{};
  std::uintmax_t bytes = 0;   ///< Of the file, or of the files of its folder.
  std::int64_t modified = 0;  ///< Seconds since 1970, of the newest of these.
  std::string problem{};      ///< Why it cannot be opened: a sentence; empty = it can.
};

/// Content of one folder, without its subfolders.
struct FolderRecord {
  std::vector<CollectionEntry> entries;
  std::vector<ListedResult> results;
  bool descends = true;  ///< Whether folders inside may hold light fields.
  /// The entries may be no light fields (pictures beside scenes): they count only if subfolders
  /// hold no other ones.
  bool is_doubtful = false;
};

/// Called for every light field as soon as it is found, with the results known by then.
using OnCollectionEntry = std::function<void(const CollectionEntry&)>;

/// Finds every light field in `root` and below, in any format and at any depth, in the order of
/// their paths. `root` may be a light field itself, or a file. A scene folder is one light field
/// and is not searched further. Light-field files in one folder are one light field each. Skips
/// hidden folders, and searches a folder once even if several links lead to it. A result file goes
/// to the light field that it names, that shares its folder, or whose name it bears. Files that
/// cannot be opened are listed with their problem. Reads headers only. Throws IoError if there is
/// no `root`. Throws Cancelled.
[[nodiscard]] std::vector<CollectionEntry> find_light_fields(const std::filesystem::path& root,
                                                             const OnCollectionEntry& on_entry,
                                                             const Progress& progress);

struct ListedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::int64_t modified_ns = 0;  ///< Since 1970.
};

/// Visible content of a folder, by name.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<ListedFile> files;  ///< Regular ones.
  std::vector<std::filesystem::path> folders;
};

/// Lists a folder. Throws filesystem_error if it cannot be read.
[[nodiscard]] FolderListing list_folder(const std::filesystem::path& folder);

/// Lists the file as if its folder held nothing else. Throws filesystem_error.
[[nodiscard]] FolderListing list_file(const std::filesystem::path& file);

/// Finds the light fields of a folder with the table of readers (reader.h): the folder itself if it
/// is a scene folder, else each of its files that is a light field. Pictures that this program made
/// (is_own_picture) are none, nor are its exports of labels. Files that cannot be opened become
/// entries with a problem. Reads headers only.
[[nodiscard]] FolderRecord scan_folder(const FolderListing& listing);

/// Light field that a file is by itself; none if it is a part of one, or none at all.
[[nodiscard]] std::optional<CollectionEntry> scan_file(const std::filesystem::path& file);

}  // namespace episcope::io
