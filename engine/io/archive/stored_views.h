// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <string>

namespace episcope::io {

/// Fills `views` from a dataset that the file stores just as they are in memory
/// (Hdf5Input::place_in_file), on several threads: most of the time of reading a large light field
/// is that of the system giving memory for it, which HDF5 would have one thread wait for. False,
/// with `views` undefined, if it is stored otherwise, in another size, or cannot be read in this
/// way. T: uint8, int32, uint16 or float. Throws IoError, Cancelled.
template <class T>
[[nodiscard]] bool read_stored_views(const Hdf5Input& file, const std::string& name,
                                     ViewStack<T>& views, const Progress& progress);

}  // namespace episcope::io
