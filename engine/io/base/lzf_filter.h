// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace episcope::io {

/// Number of the filter in HDF5's registry.
inline constexpr int kLzfFilter = 32000;
/// Place of the size of a chunk, in bytes, among the values that h5py stores with the filter.
inline constexpr std::size_t kLzfSizeAt = 2;

/// Lets the HDF5 library read samples that h5py wrote with compression="lzf", by liblzf. Call it
/// under the lock of the library, as often as you like.
void register_lzf_filter();

}  // namespace episcope::io
