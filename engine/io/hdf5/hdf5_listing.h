// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/hdf5/hdf5_file.h"

#include <hdf5.h>

#include <string>
#include <vector>

/// What a file holds. For the sources that speak to HDF5 only; their callers hold its lock.
namespace episcope::io {

/// Shape, type and blocks of an open dataset.
[[nodiscard]] Hdf5Dataset describe_dataset(hid_t dataset, const std::string& name);

/// As `Hdf5Input::datasets`, of an open file or group.
[[nodiscard]] std::vector<Hdf5Dataset> list_datasets(hid_t root);

}  // namespace episcope::io
