// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/save/file_stamp.h"

#include <filesystem>
#include <map>

namespace episcope {

/// Files that were read or written here, each as it was then, so that what another program wrote
/// since is not overwritten unnoticed.
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

}  // namespace episcope
