// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::fuzz {

/// Writes the seed scene in the forms of HDF5 that others write: samples packed by deflate and by
/// LZF, a dataset a view, planes of channels, LF in a group, LF with maps of other names, mosaics.
void write_hdf5_seeds(const std::filesystem::path& folder);

}  // namespace episcope::fuzz
