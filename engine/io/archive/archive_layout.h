// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/archive/archive_maps.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/open/scene_probe.h"
#include "engine/io/order/order_check.h"

#include <filesystem>

namespace episcope::io {

/// The dataset of an archive file that holds the views.
inline constexpr const char* kArchiveLightField = "LF";

/// How it is stored: [v][h][y][x][c] or, grey, [v][h][y][x].
struct ArchiveLayout {
  FieldShape shape;
  int channels = 1;  ///< That are read; an alpha channel is left out.
  bool has_channel_axis = true;
  Hdf5Type type = Hdf5Type::UInt8;
};

/// Throws IoError if there is no such dataset, or if it is not that of a light field.
[[nodiscard]] ArchiveLayout archive_layout(const Hdf5Input& file);

/// The order of views that attributes promise: as stated, or that of raw archive files.
[[nodiscard]] ExpectedOrder expected_order(const Hdf5Input& file);

/// What the headers of an archive file, and of labels.h5 beside it, tell. Throws IoError.
[[nodiscard]] SceneProbe probe_archive(const std::filesystem::path& path,
                                       const OpenOptions& options);

}  // namespace episcope::io
