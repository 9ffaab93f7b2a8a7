// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/hdf5/hdf5_file.h"

#include <hdf5.h>
#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// One opening of an HDF5 file, which all inputs of it share while one of them is there: readers
/// ask a file one after the other whether it is theirs. For the sources that speak to HDF5 only;
/// their callers hold its lock.
class Hdf5OpenFile {
 public:
  /// The opening that is there, unless the file has changed since; else a new one. Throws IoError
  /// that tells a missing file, another kind of file and a damaged one apart.
  [[nodiscard]] static std::shared_ptr<Hdf5OpenFile> of(const std::filesystem::path& path);

  explicit Hdf5OpenFile(const std::filesystem::path& path);
  ~Hdf5OpenFile();
  Hdf5OpenFile(const Hdf5OpenFile&) = delete;
  Hdf5OpenFile& operator=(const Hdf5OpenFile&) = delete;

  [[nodiscard]] hid_t id() const { return id_; }
  /// As `list_datasets`; `root` is the group of that name, or the file. Listed once.
  [[nodiscard]] const std::vector<Hdf5Dataset>& datasets(const std::string& group, hid_t root);

 private:
  [[nodiscard]] bool is_still(const std::filesystem::path& path) const;

  struct stat stamp_ {};
  hid_t id_ = -1;
  std::map<std::string, std::vector<Hdf5Dataset>> listed_;  ///< By group.
};

}  // namespace episcope::io
