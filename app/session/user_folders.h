// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace episcope {

/// Size and time of a file, which tell whether it is as it was last read or written.
struct FileStamp {
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type changed{};
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// The stamp of a file as it is now; the default one if there is none.
[[nodiscard]] FileStamp stamp_of(const std::filesystem::path& path);

/// Stamps of files that were read or written here, so that changes by other programs are not
/// overwritten unnoticed.
class KnownFiles {
 public:
  void note(const std::filesystem::path& file, const FileStamp& stamp);
  /// As it is now; that there is none is noted as well.
  void note(const std::filesystem::path& file) { note(file, stamp_of(file)); }
  /// Whether a file that was noted is there and another one now. False for other files.
  [[nodiscard]] bool has_changed(const std::filesystem::path& file) const;

 private:
  std::map<std::filesystem::path, FileStamp> stamps_;
};

/// A name as any file system takes it: without separators and the like, in UTF-8, and not too long.
[[nodiscard]] std::string file_name_of(std::string name);

/// What can be made again: `$XDG_CACHE_HOME/episcope`, else `~/.cache/episcope`; empty if neither
/// is known.
[[nodiscard]] std::filesystem::path default_cache_folder();

/// Has arrays that do not fit into memory go there, to a folder of their own (memory.h);
/// where it cannot be written, they go to the folder for temporary files.
void use_cache_for_scratch();

/// Folder of annotation journals: `journals` in the state folder; empty if there is none.
[[nodiscard]] std::filesystem::path default_journal_folder();

/// Folder of workspaces: `sessions` in the state folder; empty if there is none.
[[nodiscard]] std::filesystem::path default_workspace_folder();

/// Where the scribbles of a light field are kept: labels.h5 in its folder, the file that
/// io::labels_beside finds of an archive file; <stem>_labels.h5 beside a file of another form; of a
/// frame of a sequence, in the frame's folder, or labels_<frame>.h5 beside its file. Empty for
/// scenes that come from no file.
[[nodiscard]] std::filesystem::path label_place(const LightField& light_field);

/// Whether permissions allow a file to be made or overwritten there.
[[nodiscard]] bool is_writable(const std::filesystem::path& path);

/// Reads scribbles that were saved beside a light field whose format knows of no labels. Where
/// that file does not fit, that is a warning. Throws Cancelled.
void read_kept_scribbles(Scene& scene, const Progress& progress);

}  // namespace episcope
