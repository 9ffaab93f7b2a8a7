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

/// A result file (result_file.h) and what it says of itself.
struct ResultBeside {
  std::filesystem::path path;
  std::string method;
  std::string source;  ///< Its light field, as stored: absolute, or relative to the file's folder.
};

/// One light field of a collection.
struct CollectionEntry {
  std::filesystem::path path;  ///< What opens it: a scene folder or a file.
  std::string name;            ///< For lists (scene_name).
  std::string reader;          ///< Id of its reader (reader.h); empty if that is not known.
  SceneProbe probe;
  std::vector<ResultBeside> results{};
  std::uintmax_t bytes = 0;   ///< Of the file, or of the files of its folder.
  std::int64_t modified = 0;  ///< Seconds since 1970, of the newest of these.
  std::uint64_t fingerprint =
      0;                  ///< Of names, sizes and times of these: another one, another scene.
  std::string problem{};  ///< Why it cannot be opened: a sentence; empty = it can.
};

/// What one folder holds, without what lies in folders inside.
struct FolderRecord {
  std::vector<CollectionEntry> entries;
  std::vector<ResultBeside> results;
  bool descends = true;  ///< Whether folders inside may hold light fields.
  /// `entries` may be no light field after all (pictures beside scenes): they count only if nothing
  /// else lies in the folders inside.
  bool is_doubtful = false;
};

struct CollectionOptions {
  /// File that keeps what headers told (CollectionCache); empty = none.
  std::filesystem::path cache_file{};
  /// Called for every light field as soon as it is found, with the results known by then.
  std::function<void(const CollectionEntry&)> on_entry{};
};

/// Every light field in `root` and below, any form, any depth, in the order of their paths; `root`
/// may be a light field itself, or a file. A scene folder is one light field and is not searched
/// further; several light-field files in one folder are one each. Hidden folders are left out, and
/// a folder that several links lead to is searched once. Result files are given to the light field
/// that they name, that shares their folder, or whose name they have. What cannot be opened is
/// there with its problem. Reads headers only. Throws IoError if there is no `root`, Cancelled.
[[nodiscard]] std::vector<CollectionEntry> find_light_fields(const std::filesystem::path& root,
                                                             const CollectionOptions& options,
                                                             const Progress& progress);

/// What folders held when they were last looked at, in a file that may be lost or damaged at any
/// time: then everything is looked at again. It keeps only the folders of the last listing.
class CollectionCache {
 public:
  /// Reads the file, if there is one that this version wrote with the same readers. An empty path
  /// keeps nothing.
  explicit CollectionCache(std::filesystem::path file);

  /// What the folder held when it had this fingerprint; null if that is not
  /// known.
  [[nodiscard]] const FolderRecord* find(const std::filesystem::path& folder,
                                         std::uint64_t fingerprint) const;
  void keep(const std::filesystem::path& folder, std::uint64_t fingerprint, FolderRecord record);
  /// Writes what was kept, unless that is what was read. Does nothing where that is not possible.
  void save() const;

 private:
  struct Kept {
    std::uint64_t fingerprint = 0;
    FolderRecord record;
  };
  using Records = std::map<std::string, Kept>;

  void read();

  std::filesystem::path file_;
  Records old_;
  Records new_;
  bool has_changed_ = false;
};

struct ListedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::int64_t modified_ns = 0;  ///< Since 1970.
};

/// What lies directly in a folder, hidden things aside, by name.
struct FolderListing {
  std::filesystem::path folder;
  std::vector<ListedFile> files;  ///< Regular ones.
  std::vector<std::filesystem::path> folders;
  std::uint64_t fingerprint = 0;  ///< Of names, sizes and times of all this.
};

/// Throws filesystem_error for a folder that cannot be read.
[[nodiscard]] FolderListing list_folder(const std::filesystem::path& folder);

/// The file alone, as if it were all that its folder holds. Throws filesystem_error.
[[nodiscard]] FolderListing list_file(const std::filesystem::path& file);

/// Which light fields a folder holds, by the table of readers (reader.h): itself, if it is a scene
/// folder, or those of its files that are light fields each. What cannot be opened is an entry with
/// a problem. Reads headers only.
[[nodiscard]] FolderRecord scan_folder(const FolderListing& listing);

/// The light field that a file is by itself; none if it is a part of one, or none at all.
[[nodiscard]] std::optional<CollectionEntry> scan_file(const std::filesystem::path& file);

}  // namespace episcope::io
