// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

namespace episcope::io {

/// A folder that appears under its name only when it is whole: filled as a hidden folder beside it,
/// then renamed. Whatever happens before `commit`, nothing is there under the name, and the
/// destructor removes what was written.
class AtomicFolder {
 public:
  /// `bytes`: the expected size, to refuse at once what cannot fit. Throws IoError if `target` is a
  /// file or holds files, or if nothing can be written beside it.
  explicit AtomicFolder(const std::filesystem::path& target, std::uintmax_t bytes = 0);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to write until `commit`.
  [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
  /// Throws IoError that names the target.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temporary_;  ///< Empty once renamed.
};

}  // namespace episcope::io
