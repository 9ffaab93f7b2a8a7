// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/open/open_options.h"

#include <string>

namespace episcope::io {

/// Size of the light field that maps must fit.
struct FieldShape {
  GridShape grid;
  int height = 0;
  int width = 0;
};

/// Reads `[v][h][y][x]`, `[1][1][y][x]` or `[y][x]` view by view, in the stored order; the latter
/// two belong to the centre view; `Center` reads that alone. T: uint8, int32 or float. Throws
/// IoError for another rank or size.
template <class T>
[[nodiscard]] ViewStack<T> read_maps(const Hdf5Input& file, const std::string& name,
                                     const FieldShape& shape, const Progress& progress,
                                     MapViews views = MapViews::All);

}  // namespace episcope::io
