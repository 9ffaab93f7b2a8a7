// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/base/hdf5_file.h"
#include "engine/io/models/open_options.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <optional>
#include <string>

namespace episcope::io {

/// All views in one image: lenslets side by side (ESLF of Lytro cameras, MacPI), or views side by
/// side.
[[nodiscard]] Reader mosaic_reader();

/// A dataset of two axes that holds all views as one picture.
struct MosaicDataset {
  std::string name;
  Hdf5Shape shape;  ///< As stored.
  Hdf5Type type = Hdf5Type::Float;
  Mosaic kind = Mosaic::Auto;  ///< By its name.
  bool is_transposed = false;  ///< Stored `[x][y]`.
  GridShape grid{};            ///< By an attribute; 0×0 = none states it.
};

/// Finds the largest dataset named as a mosaic: SAI for views side by side, MacPI for lenslets.
/// Data for super-resolution has `Hr_SAI_y` and `Lr_SAI_y`, stored `[x][y]` (source: the scripts of
/// Liang's BasicLFSR). If options ask for a mosaic, takes the dataset of the option `dataset`,
/// stored `[y][x]`. The attribute angRes or grid, of the dataset or the root, gives rows and
/// columns. Empty for files that are no HDF5 files, or hold LF or a result. Throws IoError.
[[nodiscard]] std::optional<MosaicDataset> find_mosaic_dataset(const std::filesystem::path& path,
                                                               const OpenOptions& options);

}  // namespace episcope::io
