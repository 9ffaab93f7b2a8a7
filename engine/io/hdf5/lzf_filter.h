// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace episcope::io {

/// Number of the filter in HDF5's registry.
inline constexpr int kLzfFilter = 32000;
/// Place of the size of a chunk, in bytes, among the values that h5py stores with the filter.
inline constexpr std::size_t kLzfSizeAt = 2;

/// Lets the library read samples that h5py wrote with compression="lzf", by liblzf. To be
/// called under the lock, as often as one likes.
void register_lzf_filter();

}  // namespace episcope::io
