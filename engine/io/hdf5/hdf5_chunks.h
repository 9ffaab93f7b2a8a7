// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/hdf5/hdf5_file.h"

#include <hdf5.h>

namespace episcope::io {

/// Whether a chunk that the block lies in is stored without compression, and shorter than chunks
/// are: HDF5 1.10 reads beyond it. True also if HDF5 cannot tell; false for datasets without
/// chunks. For the sources that speak to HDF5 only.
[[nodiscard]] bool has_short_chunk(hid_t dataset, const Hdf5Block& block);

/// Whether chunks are no larger than the dataset may become, and the first of them, if it is
/// deflated, holds as many samples as chunks do: the library would read beyond it. If they are
/// packed by LZF, their size must be stated with the filter, which makes room for it. True for
/// datasets without chunks.
[[nodiscard]] bool has_sound_chunks(hid_t dataset);

}  // namespace episcope::io
