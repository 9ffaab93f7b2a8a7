// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"
#include "engine/core/light_field/light_field.h"
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

[[nodiscard]] FieldShape field_shape(const LightField::Samples& samples);

/// Reads `[v][h][y][x]`, `[1][1][y][x]` or `[y][x]` view by view, in the stored order; the latter
/// two belong to the centre view; `Center` reads that alone. Also with a last axis of length 1, and
/// all at once with all axes in the opposite order, as MATLAB writes them, where the lengths tell:
/// `[x][y]` of a square view cannot be told from `[y][x]`. T: uint8, int32 or float. Throws IoError
/// for another rank or size.
template <class T>
[[nodiscard]] ViewStack<T> read_maps(const Hdf5Input& file, const std::string& name,
                                     const FieldShape& shape, const Progress& progress,
                                     MapViews views = MapViews::All);

/// Whether the rank and size of a dataset are those that `read_maps` reads.
[[nodiscard]] bool holds_maps(const Hdf5Input& file, const std::string& name,
                              const FieldShape& shape);
/// Whether the axes are stored in the opposite order. Throws as `read_maps`.
[[nodiscard]] bool is_column_major(const Hdf5Input& file, const std::string& name,
                                   const FieldShape& shape);

}  // namespace episcope::io
