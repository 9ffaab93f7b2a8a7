// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::io {

/// Number of the filter in HDF5's registry.
inline constexpr int kLzfFilter = 32000;

/// Lets the library read samples that h5py wrote with compression="lzf", by liblzf. To be
/// called under the lock, as often as one likes.
void register_lzf_filter();

}  // namespace episcope::io
