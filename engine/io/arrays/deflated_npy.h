// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_input.h"
#include "engine/io/arrays/inflate_stream.h"
#include "engine/io/arrays/npy_header.h"
#include "engine/io/arrays/zip_file.h"

#include <filesystem>
#include <memory>

namespace episcope::io {

/// The header of an `.npy` file inside of an archive. Throws IoError.
[[nodiscard]] NpyHeader read_zipped_header(const std::filesystem::path& path,
                                           const ZipEntry& entry);

/// An `.npy` file that is deflated in an archive: inflated piece by piece while it is read.
class DeflatedNpy : public LinearArray {
 public:
  /// `header` is that of `entry`. Throws IoError.
  DeflatedNpy(const std::filesystem::path& path, const ZipEntry& entry, NpyHeader header);
  [[nodiscard]] bool is_sequential() const override { return true; }

 private:
  void read_elements(std::size_t first, std::size_t count, std::uint8_t* out) const override;

  ZipEntry entry_;
  NpyHeader header_;
  mutable std::unique_ptr<InflateStream> stream_;
};

}  // namespace episcope::io
