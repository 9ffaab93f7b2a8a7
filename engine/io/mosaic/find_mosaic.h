// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/open_options.h"

#include <filesystem>

namespace episcope::io {

/// The picture that holds all views, if `path` is one, an HDF5 file with one
/// (`find_mosaic_dataset`), or a folder with one: by its name, because
/// options ask for a mosaic, or because no other image of the folder is as large, while the folder
/// has no other form. Reads headers of images only. Throws IoError for a folder with several.
[[nodiscard]] std::filesystem::path find_mosaic(const std::filesystem::path& path,
                                                const OpenOptions& options);

/// Whether no other image of its folder holds all views of another light field.
[[nodiscard]] bool is_only_mosaic(const std::filesystem::path& picture);

}  // namespace episcope::io
