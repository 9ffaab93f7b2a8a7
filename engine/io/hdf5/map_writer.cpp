// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/hdf5/map_writer.h"

#include <limits>
#include <vector>

namespace episcope::io {

Hdf5Shape map_shape(GridShape grid, int height, int width) {
  const Hdf5Shape view{static_cast<std::size_t>(height), static_cast<std::size_t>(width)};
  if (grid.count() == 1) return view;
  return {static_cast<std::size_t>(grid.v), static_cast<std::size_t>(grid.u), view[0], view[1]};
}

const char* map_axes(GridShape grid) {
  return grid.count() == 1 ? "y,x" : "v,u,y,x";
}

template <class T>
void write_maps(Hdf5Output& file, const std::string& name, const MapGeometry& maps,
                const std::string& units, const Progress& progress,
                const std::function<const T*(ViewIndex)>& samples) {
  const GridShape grid = maps.grid;
  const Hdf5Shape shape = map_shape(grid, maps.height, maps.width);
  file.add_dataset<T>(name, shape, map_axes(grid), units);
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex place = grid.view_at(i);
    Hdf5Block block{Hdf5Shape(shape.size(), 0), shape};
    if (grid.count() > 1) {
      block.start[0] = static_cast<std::size_t>(place.v);
      block.start[1] = static_cast<std::size_t>(place.u);
      block.count[0] = block.count[1] = 1;
    }
    file.write(name, block, samples({maps.first.v + place.v, maps.first.u + place.u}));
    progress.report((i + 1.0) / grid.count());
  }
}

template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const std::uint8_t*(ViewIndex)>&);
template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const std::int32_t*(ViewIndex)>&);
template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const float*(ViewIndex)>&);

void write_disparity(Hdf5Output& file, const std::string& name, const DisparityField& field,
                     const Progress& progress) {
  std::vector<float> marked;
  write_maps<float>(file, name, geometry_of(field.disparity), "px per view step", progress,
                    [&](ViewIndex view) -> const float* {
                      const auto disparity = field.disparity.view(view);
                      if (field.valid.empty()) return disparity.data;
                      const auto valid = field.valid.view(view);
                      marked.assign(disparity.data, disparity.data + disparity.size());
                      for (std::size_t i = 0; i < marked.size(); ++i) {
                        if (valid.data[i] == 0) marked[i] = std::numeric_limits<float>::quiet_NaN();
                      }
                      return marked.data();
                    });
}

}  // namespace episcope::io
