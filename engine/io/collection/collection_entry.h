// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/scene_probe.h"

#include <cstdint>
#include <filesystem>
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

}  // namespace episcope::io
