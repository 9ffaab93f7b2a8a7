// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// HDF5 files of any other form than the archive's that hold a light field: a dataset of five axes
/// of any name and order, or groups of a dataset for each channel.
[[nodiscard]] Reader hdf5_array_reader();

}  // namespace episcope::io
