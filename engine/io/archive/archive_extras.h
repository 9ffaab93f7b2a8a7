// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/io/archive/archive_maps.h"

namespace episcope::io {

/// What Episcope alone writes into a file of the archive form (archive_names.h). Each throws
/// IoError for a part that does not fit the light field, Cancelled.

/// Positions of the cameras and their unit, row by row as stored; unknown if there are none.
void read_positions(const Hdf5Input& file, GridShape grid, LightFieldInfo& info);

/// The mask of valid pixels as stored; empty if there is none.
[[nodiscard]] ViewStack<std::uint8_t> read_valid(const Hdf5Input& file, const FieldShape& shape,
                                                 const Progress& progress);

/// Region masks by name.
[[nodiscard]] std::map<std::string, Image<std::uint8_t>> read_regions(const Hdf5Input& file,
                                                                      const FieldShape& shape);

}  // namespace episcope::io
