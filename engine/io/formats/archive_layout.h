// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/hdf5_file.h"
#include "engine/io/models/order/order_check.h"
#include "engine/io/models/reader.h"
#include "engine/io/models/stored_maps.h"

#include <filesystem>
#include <memory>
#include <string>

namespace episcope::io {

/// Finds the only group that holds LF in the form of the archive with GT_DEPTH or its two layers
/// beside it, in a file without LF at its root. Empty if there is none, or several.
[[nodiscard]] std::string archive_group(const Hdf5Input& file);

/// Opens a file of the archive, with that group in place of the root. Throws IoError.
[[nodiscard]] std::shared_ptr<const Hdf5Input> open_archive_file(const std::filesystem::path& path);

/// The dataset of an archive file that holds the views.
inline constexpr const char* kArchiveLightField = "LF";

/// How it is stored: [v][h][y][x][c] or, grey, [v][h][y][x].
struct ArchiveLayout {
  FieldShape shape;
  int channels = 1;  ///< That are read; an alpha channel is left out.
  bool has_channel_axis = true;
  Hdf5Type type = Hdf5Type::UInt8;
};

/// Reads the layout. Throws IoError if there is no such dataset, or if it holds no light field.
[[nodiscard]] ArchiveLayout archive_layout(const Hdf5Input& file);

/// Warns of attributes that state another size than the shape of LF.
void compare_sizes(const Hdf5Input& file, ConventionReport& report);

/// Order of views by the attributes: as stated, else the order of raw archive files.
[[nodiscard]] ExpectedOrder expected_order(const Hdf5Input& file);

/// Probes the headers of an archive file, and of labels.h5 beside it. Throws IoError.
[[nodiscard]] SceneProbe probe_archive(const std::filesystem::path& path,
                                       const OpenOptions& options);

}  // namespace episcope::io
