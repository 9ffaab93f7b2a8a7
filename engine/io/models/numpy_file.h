// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/zip.h"
#include "engine/io/models/array_file.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// `.npy` files, alone or in a folder, and `.npz` archives of them, by name without suffix.
class NumpyFile : public ArrayFile {
 public:
  /// Opens an archive, a folder, or one `.npy` with the maps beside it. Throws IoError.
  explicit NumpyFile(const std::filesystem::path& path);
  [[nodiscard]] std::optional<Provenance> estimated(const std::string& map) const override;

 private:
  [[nodiscard]] std::unique_ptr<ArrayInput> open_stored(const ArrayEntry& entry) const override;

  struct Source {
    std::string name;
    std::filesystem::path path;
    std::optional<ZipEntry> zipped;
    std::string told{};  ///< As in ArrayEntry.
  };
  void add_source(Source source, bool is_needed);
  void add_archive(const std::filesystem::path& path);

  std::vector<Source> sources_;
  std::string estimated_;  ///< The text of `kEstimatedFile`.
};

/// Whether a folder holds pictures as `.npy` files, numbered, and no images.
[[nodiscard]] bool is_folder_of_views(const std::filesystem::path& folder);

/// Whether a file is an `.npy` or `.npz` file by its suffix or first bytes.
[[nodiscard]] bool is_numpy_file(const std::filesystem::path& path);

}  // namespace episcope::io
