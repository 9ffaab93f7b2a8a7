// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_maps.h"

#include "engine/core/error.h"
#include "engine/io/archive/stored_views.h"

#include <fmt/format.h>

namespace episcope::io {
namespace {

bool is_one_view(const Hdf5Input& file, const Hdf5Dataset& dataset, const FieldShape& shape) {
  const Hdf5Shape view{static_cast<std::size_t>(shape.height),
                       static_cast<std::size_t>(shape.width)};
  const Hdf5Shape single{1, 1, view[0], view[1]};
  const Hdf5Shape all{static_cast<std::size_t>(shape.grid.v),
                      static_cast<std::size_t>(shape.grid.u), view[0], view[1]};
  const std::string expected = shape_text(all) + " or " + shape_text(view);
  const std::string what = "the dataset " + dataset.name + " has ";
  if (dataset.shape.size() != 2 && dataset.shape.size() != 4) {
    throw IoError(file.path(),
                  fmt::format("{}{} axes ({}), but {} is expected; store it in this form", what,
                              dataset.shape.size(), shape_text(dataset.shape), expected));
  }
  if (dataset.shape == view || dataset.shape == single) return true;
  if (dataset.shape == all) return false;
  throw IoError(file.path(), what + "the shape " + shape_text(dataset.shape) + ", but " + expected +
                                 " is expected to fit the light field; store it in this form");
}

}  // namespace

template <class T>
ViewStack<T> read_maps(const Hdf5Input& file, const std::string& name, const FieldShape& shape,
                       const Progress& progress, MapViews views) {
  const Hdf5Dataset dataset = file.dataset(name);
  const auto height = static_cast<std::size_t>(shape.height);
  const auto width = static_cast<std::size_t>(shape.width);
  if (is_one_view(file, dataset, shape)) {
    progress.check();
    ViewStack<T> stack({1, 1}, shape.height, shape.width, 1, shape.grid.center());
    const Hdf5Shape origin(dataset.shape.size(), 0);
    file.read(name, {origin, dataset.shape}, stack.data());
    return stack;
  }
  const bool is_center = views == MapViews::Center;
  const ViewIndex first = is_center ? shape.grid.center() : ViewIndex{};
  const GridShape grid = is_center ? GridShape{1, 1} : shape.grid;
  ViewStack<T> stack(grid, shape.height, shape.width, 1, first);
  if (!is_center && read_stored_views(file, name, stack, progress)) return stack;
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex view = grid.view_at(i, first);
    const Hdf5Block block{
        {static_cast<std::size_t>(view.v), static_cast<std::size_t>(view.u), 0, 0},
        {1, 1, height, width}};
    file.read(name, block, stack.view(view).data);
    progress.report((i + 1.0) / grid.count());
  }
  return stack;
}

template ViewStack<std::uint8_t> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                           const Progress&, MapViews);
template ViewStack<std::int32_t> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                           const Progress&, MapViews);
template ViewStack<float> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                    const Progress&, MapViews);

}  // namespace episcope::io
