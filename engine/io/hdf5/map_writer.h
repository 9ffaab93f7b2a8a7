// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/map_block.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <functional>
#include <string>

namespace episcope::io {

/// Which views a stack of maps holds, as a shape of a dataset: `[y][x]` for a single view, else
/// `[v][u][y][x]`.
[[nodiscard]] Hdf5Shape map_shape(GridShape grid, int height, int width);

/// "y,x" or "v,u,y,x".
[[nodiscard]] const char* map_axes(GridShape grid);

/// Adds a dataset and writes it view by view: `samples(view)` gives those of each. T: uint8, int32
/// or float.
template <class T>
void write_maps(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                const std::string& units, const Progress& progress,
                const std::function<const T*(ViewIndex)>& samples);

/// Writes a stack as it is.
template <class T>
void write_stack(Hdf5Output& file, const std::string& name, const ViewStack<T>& stack,
                 const std::string& units, const Progress& progress) {
  write_maps<T>(file, name, geometry_of(stack), units, progress,
                [&](ViewIndex view) { return stack.view(view).data; });
}

/// Writes disparity with NaN at invalid pixels.
void write_disparity(Hdf5Output& file, const std::string& name, const DisparityField& field,
                     const Progress& progress);

}  // namespace episcope::io
