// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/hdf5/hdf5_file.h"

#include <hdf5.h>

#include <cstdint>
#include <type_traits>
#include <vector>

/// What reading and writing blocks of a dataset share. For the sources that speak to HDF5 only.
namespace episcope::io {

static_assert(sizeof(hid_t) == sizeof(std::int64_t));

template <class T>
hid_t native_type() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return H5T_NATIVE_UINT8;
  if constexpr (std::is_same_v<T, std::uint16_t>) return H5T_NATIVE_UINT16;
  if constexpr (std::is_same_v<T, std::int32_t>) return H5T_NATIVE_INT32;
  if constexpr (std::is_same_v<T, float>) return H5T_NATIVE_FLOAT;
  if constexpr (std::is_same_v<T, double>) return H5T_NATIVE_DOUBLE;
}

/// Selects the block; false if the dataset has another rank or no such place.
inline bool select_block(hid_t space, const Hdf5Block& block) {
  const std::vector<hsize_t> start(block.start.begin(), block.start.end());
  const std::vector<hsize_t> count(block.count.begin(), block.count.end());
  if (static_cast<int>(start.size()) != H5Sget_simple_extent_ndims(space)) return false;
  return start.empty() || H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr,
                                              count.data(), nullptr) >= 0;
}

/// Of the rank of the block: HDF5 walks through selections of different ranks element by element.
inline hid_t memory_space(const Hdf5Block& block) {
  const std::vector<hsize_t> count(block.count.begin(), block.count.end());
  return count.empty() ? H5Screate(H5S_SCALAR)
                       : H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr);
}

}  // namespace episcope::io
