// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/estimate.h"
#include "engine/core/light_field/map_block.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <string>

namespace episcope::io {

/// The group of a result file that holds maps, and in its attributes where they come from.
inline constexpr const char* kResultGroup = "estimate";
/// Unit of its disparities.
inline constexpr const char* kDisparityUnit = "px per view step";

/// "estimate/<name>".
[[nodiscard]] std::string in_group(const char* name);

/// Writes where maps of this geometry come from; `source` in the place of the estimate's own.
/// Throws IoError.
void write_provenance(Hdf5Output& file, const Provenance& estimate, const MapGeometry& maps,
                      const std::string& source);

}  // namespace episcope::io
