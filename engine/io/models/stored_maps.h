// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/estimate.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/io/base/array_layout.h"
#include "engine/io/base/hdf5_output.h"
#include "engine/io/models/open_options.h"

#include <functional>
#include <string>

namespace episcope::io {

/// Size of the light field that maps must fit.
struct FieldShape {
  GridShape grid;
  int height = 0;
  int width = 0;
};

[[nodiscard]] FieldShape field_shape(const LightField::Samples& samples);

/// Reads `[v][h][y][x]`, `[1][1][y][x]` or `[y][x]` view by view, in the stored order. The latter
/// two belong to the center view; `Center` reads that alone. A last axis of length 1 is accepted.
/// So is the opposite order of all axes, as MATLAB writes it, if the lengths tell: `[x][y]` of a
/// square view is taken for `[y][x]`. T: uint8, int32 or float. Throws IoError for another rank or
/// size.
template <class T>
[[nodiscard]] ViewStack<T> read_maps(const Hdf5Input& file, const std::string& name,
                                     const FieldShape& shape, const Progress& progress,
                                     MapViews views = MapViews::All);

/// Whether `read_maps` reads a dataset of this rank and size.
[[nodiscard]] bool holds_maps(const Hdf5Input& file, const std::string& name,
                              const FieldShape& shape);
/// Whether the axes are stored in the opposite order. Throws as `read_maps`.
[[nodiscard]] bool is_column_major(const Hdf5Input& file, const std::string& name,
                                   const FieldShape& shape);

/// Order of the axes of maps, of two or four axes, as their file states it: by the attribute `axes`
/// ("x,y"), by labels of the dimensions or the names of their scales ("y", "rows", "height"), or as
/// a file of MATLAB, whose axes are reversed. Without such a statement, or with one that names
/// other axes, `[y][x]` or
/// `[v][u][y][x]`.
[[nodiscard]] ArrayLayout stated_map_layout(const Hdf5Input& file, const Hdf5Dataset& dataset);

/// Reads maps of this layout, at view `first`. Throws IoError. T: uint8 or float.
template <class T>
[[nodiscard]] ViewStack<T> read_laid_out(const Hdf5Input& file, const std::string& name,
                                         const ArrayLayout& layout, ViewIndex first);

/// Fills `views` on several threads from a dataset stored as in memory (Hdf5Input::place_in_file).
/// Most of the time of reading a large light field goes into getting memory from the system, which
/// HDF5 does on one thread. False, with `views` undefined, if the dataset is stored otherwise or
/// has another size. T: uint8, int32, uint16 or float. Throws IoError, Cancelled.
template <class T>
[[nodiscard]] bool read_stored_views(const Hdf5Input& file, const std::string& name,
                                     ViewStack<T>& views, const Progress& progress);

/// Fills `views` from a dataset whose chunks hold several views each, by rows of views, so that
/// each chunk is unpacked once. False, with nothing done, if chunks do not. Of more channels than
/// `views` has the first are read. T: uint8, int32, uint16 or float. Throws IoError, Cancelled.
template <class T>
[[nodiscard]] bool read_rows_of_views(const Hdf5Input& file, const std::string& name,
                                      ViewStack<T>& views, const Progress& progress);

/// Shape of the dataset of a stack of maps: `[y][x]` for a single view, else `[v][u][y][x]`.
[[nodiscard]] Hdf5Shape map_shape(GridShape grid, int height, int width);

/// "y,x" or "v,u,y,x".
[[nodiscard]] const char* map_axes(GridShape grid);

/// Adds a dataset and writes it view by view; `samples(view)` gives the samples of a view. T:
/// uint8, int32 or float.
template <class T>
void write_maps(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                const std::string& units, const Progress& progress,
                const std::function<const T*(ViewIndex)>& samples);

/// Writes a stack unchanged.
template <class T>
void write_stack(Hdf5Output& file, const std::string& name, const ViewStack<T>& stack,
                 const std::string& units, const Progress& progress) {
  write_maps<T>(file, name, geometry_of(stack), units, progress,
                [&](ViewIndex view) { return stack.view(view).data; });
}

/// Disparity with NaN at invalid pixels.
[[nodiscard]] Image<float> marked_map(const DisparityView& map);

/// Writes such maps of these views; NaN for a view without one.
void write_disparity(Hdf5Output& file, const std::string& name, const DisparityField& field,
                     const MapGeometry& maps, const Progress& progress);

}  // namespace episcope::io
