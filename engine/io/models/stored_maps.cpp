// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/stored_maps.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/models/array_file.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace episcope::io {
namespace {

Hdf5Shape reversed(Hdf5Shape shape) {
  std::ranges::reverse(shape);
  return shape;
}

/// How a dataset holds maps.
struct MapForm {
  bool is_one_view = false;
  /// `[x][y][h][v]` or `[x][y]`: as MATLAB and Fortran write `[v][h][y][x]`.
  bool is_column_major = false;
};

/// A channel axis of length 1 behind the others says nothing.
Hdf5Shape map_shape(const Hdf5Dataset& dataset) {
  Hdf5Shape shape = dataset.shape;
  const bool has_channel = shape.size() == 3 || shape.size() == 5;
  if (has_channel && shape.back() == 1) shape.pop_back();
  return shape;
}

struct ExpectedShapes {
  Hdf5Shape view, all;
};

ExpectedShapes expected_shapes(const FieldShape& shape) {
  const auto length = [](int value) { return static_cast<std::size_t>(value); };
  const Hdf5Shape view{length(shape.height), length(shape.width)};
  return {view, {length(shape.grid.v), length(shape.grid.u), view[0], view[1]}};
}

std::optional<MapForm> find_form(const Hdf5Dataset& dataset, const FieldShape& shape) {
  const auto [view, all] = expected_shapes(shape);
  const Hdf5Shape stored = map_shape(dataset);
  for (const bool is_column_major : {false, true}) {
    const Hdf5Shape found = is_column_major ? reversed(stored) : stored;
    if (found == view || found == Hdf5Shape{1, 1, view[0], view[1]})
      return {{true, is_column_major}};
    if (found == all) return {{false, is_column_major}};
  }
  return std::nullopt;
}

MapForm form_of(const Hdf5Input& file, const Hdf5Dataset& dataset, const FieldShape& shape) {
  if (const auto form = find_form(dataset, shape)) return *form;
  const auto [view, all] = expected_shapes(shape);
  const std::string expected = shape_text(all) + " or " + shape_text(view);
  const std::string what = "the dataset " + dataset.name + " has ";
  const std::size_t axes = map_shape(dataset).size();
  if (axes != 2 && axes != 4) {
    throw IoError(file.path(),
                  fmt::format("{}{} axes ({}), but {} is expected; store it in this form", what,
                              dataset.shape.size(), shape_text(dataset.shape), expected));
  }
  throw IoError(file.path(), what + "the shape " + shape_text(dataset.shape) + ", but " + expected +
                                 " is expected to fit the light field; store it in this form");
}

/// `[x][y][h][v]`, or of one view `[x][y]`.
ArrayLayout column_major_layout(const Hdf5Dataset& dataset) {
  std::string axes = dataset.shape.size() < 4 ? "xy" : "xyuv";
  axes.resize(dataset.shape.size(), kSingle);
  return {dataset.shape, axes};
}

}  // namespace

template <class T>
ViewStack<T> read_maps(const Hdf5Input& file, const std::string& name, const FieldShape& shape,
                       const Progress& progress, MapViews views) {
  const Hdf5Dataset dataset = file.dataset(name);
  const auto height = static_cast<std::size_t>(shape.height);
  const auto width = static_cast<std::size_t>(shape.width);
  const MapForm form = form_of(file, dataset, shape);
  const ViewIndex center = shape.grid.center();
  progress.check();
  if (form.is_column_major) {
    ViewStack<T> all = read_laid_out<T>(file, name, column_major_layout(dataset),
                                        form.is_one_view ? center : ViewIndex{});
    if (form.is_one_view || views == MapViews::All) return all;
    ViewStack<T> one({1, 1}, shape.height, shape.width, 1, center);
    std::copy_n(all.view(center).data, one.size(), one.data());
    return one;
  }
  if (form.is_one_view) {
    ViewStack<T> stack({1, 1}, shape.height, shape.width, 1, center);
    const Hdf5Shape origin(dataset.shape.size(), 0);
    file.read(name, {origin, dataset.shape}, stack.data());
    return stack;
  }
  const bool is_center = views == MapViews::Center;
  const ViewIndex first = is_center ? center : ViewIndex{};
  const GridShape grid = is_center ? GridShape{1, 1} : shape.grid;
  ViewStack<T> stack(grid, shape.height, shape.width, 1, first);
  const bool is_read = !is_center && (read_stored_views(file, name, stack, progress) ||
                                      read_rows_of_views(file, name, stack, progress));
  if (is_read) return stack;
  for (int i = 0; i < grid.count(); ++i) {
    progress.check();
    const ViewIndex view = grid.view_at(i, first);
    Hdf5Block block{{static_cast<std::size_t>(view.v), static_cast<std::size_t>(view.u), 0, 0},
                    {1, 1, height, width}};
    block.start.resize(dataset.shape.size(), 0);
    block.count.resize(dataset.shape.size(), 1);
    file.read(name, block, stack.view(view).data);
    progress.report((i + 1.0) / grid.count());
  }
  return stack;
}

FieldShape field_shape(const LightField::Samples& samples) {
  return std::visit(
      [](const auto& stack) {
        return FieldShape{stack.grid(), stack.height(), stack.width()};
      },
      samples);
}

bool holds_maps(const Hdf5Input& file, const std::string& name, const FieldShape& shape) {
  return find_form(file.dataset(name), shape).has_value();
}

bool is_column_major(const Hdf5Input& file, const std::string& name, const FieldShape& shape) {
  return form_of(file, file.dataset(name), shape).is_column_major;
}

template ViewStack<std::uint8_t> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                           const Progress&, MapViews);
template ViewStack<std::int32_t> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                           const Progress&, MapViews);
template ViewStack<float> read_maps(const Hdf5Input&, const std::string&, const FieldShape&,
                                    const Progress&, MapViews);

namespace {

/// The letter of an axis that is named so ("y", "rows", "height"); ? for any other name.
char axis_letter(std::string name) {
  name = lower_case(name);
  if (name == "y" || name == "row" || name == "rows" || name == "height") return 'y';
  if (name == "x" || name == "column" || name == "columns" || name == "width") return 'x';
  if (name == "v" || name == "t") return 'v';
  if (name == "u" || name == "s") return 'u';
  return '?';
}

/// Letters of axes that have a name each.
std::string named_axes(const std::vector<std::string>& names) {
  std::string letters;
  for (const std::string& name : names) letters += axis_letter(name);
  return letters;
}

/// Letters of the axes that an attribute lists: "x,y", "xy", "u, v, x, y", "height width".
std::string listed_axes(const std::string& list) {
  std::vector<std::string> names(1);
  for (const char c : list) {
    if (c != ',' && c != ' ') {
      names.back() += c;
    } else if (!names.back().empty()) {
      names.emplace_back();
    }
  }
  if (names.size() > 1) return named_axes(names);
  std::string letters;
  for (const char c : list) letters += axis_letter({c});
  return letters;
}

/// Whether Octave saved it with -hdf5: the group of a variable is marked, and axes are reversed as
/// by MATLAB.
bool is_octave_variable(const Hdf5Input& file, const std::string& dataset) {
  const std::size_t end = dataset.rfind('/');
  return end != std::string::npos &&
         file.has_attribute(dataset.substr(0, end), "OCTAVE_NEW_FORMAT");
}

}  // namespace

ArrayLayout stated_map_layout(const Hdf5Input& file, const Hdf5Dataset& dataset) {
  const std::string usual = dataset.shape.size() == 2 ? "yx" : "vuyx";
  for (const std::string& stated : {listed_axes(file.text(dataset.name, "axes").value_or("")),
                                    named_axes(file.texts(dataset.name, "axes")),
                                    named_axes(file.texts(dataset.name, "DIMENSION_LABELS")),
                                    named_axes(file.scale_names(dataset.name))}) {
    if (std::ranges::is_permutation(stated, usual)) return {dataset.shape, stated};
  }
  const bool is_reversed = is_matlab_hdf5(file) || is_octave_variable(file, dataset.name);
  const IndexOrder order = is_reversed ? IndexOrder::Fortran : IndexOrder::C;
  return {dataset.shape, in_index_order(usual, order)};
}

template <class T>
ViewStack<T> read_laid_out(const Hdf5Input& file, const std::string& name,
                           const ArrayLayout& layout, ViewIndex first) {
  ViewStack<T> stack(layout.grid(), layout.height(), layout.width(), 1, first);
  const Hdf5Block all{Hdf5Shape(layout.shape.size(), 0), layout.shape};
  if (layout.axes == "yx" || layout.axes == "vuyx") {
    file.read(name, all, stack.data());
    return stack;
  }
  // In large memory, which a size that a damaged file claims does not fill.
  ViewStack<T> stored(layout.grid(), layout.height(), layout.width());
  file.read(name, all, stored.data());
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex at = stack.grid().view_at(i);
    const auto out = stack.view(stack.view_at(i));
    const std::size_t begin = static_cast<std::size_t>(at.v) * layout.stride('v') +
                              static_cast<std::size_t>(at.u) * layout.stride('u');
    for (int y = 0; y < out.height; ++y) {
      const std::size_t row = begin + static_cast<std::size_t>(y) * layout.stride('y');
      for (int x = 0; x < out.width; ++x) {
        out.at(y, x) = stored.data()[row + static_cast<std::size_t>(x) * layout.stride('x')];
      }
    }
  }
  return stack;
}

template ViewStack<std::uint8_t> read_laid_out(const Hdf5Input&, const std::string&,
                                               const ArrayLayout&, ViewIndex);
template ViewStack<std::int32_t> read_laid_out(const Hdf5Input&, const std::string&,
                                               const ArrayLayout&, ViewIndex);
template ViewStack<float> read_laid_out(const Hdf5Input&, const std::string&, const ArrayLayout&,
                                        ViewIndex);

template <class T>
bool read_stored_views(const Hdf5Input& file, const std::string& name, ViewStack<T>& views,
                       const Progress& progress) {
  const Hdf5Shape shape = file.dataset(name).shape;
  const std::size_t size =
      std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
  const auto begin = file.place_in_file<T>(name);
  if (!begin || size != views.size()) return false;
  const FileDescriptor descriptor(file.path(), O_RDONLY | O_CLOEXEC);
  if (!descriptor.ok()) return false;
  const std::size_t bytes = views.view_size() * sizeof(T);
  std::atomic<bool> is_read = true;
  parallel_for(views.grid().count(), progress, [&](int i) {
    auto* const out = reinterpret_cast<std::uint8_t*>(views.view(views.view_at(i)).data);
    const std::uintmax_t place = *begin + static_cast<std::uintmax_t>(i) * bytes;
    if (is_read && !read_all_at(descriptor.id(), std::span(out, bytes), place)) is_read = false;
  });
  return is_read;
}

template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::uint8_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::int32_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<std::uint16_t>&,
                                const Progress&);
template bool read_stored_views(const Hdf5Input&, const std::string&, ViewStack<float>&,
                                const Progress&);

template <class T>
bool read_rows_of_views(const Hdf5Input& file, const std::string& name, ViewStack<T>& views,
                        const Progress& progress) {
  const Hdf5Dataset dataset = file.dataset(name);
  const Hdf5Shape& chunk = dataset.chunk;
  if (chunk.size() < 4 || (chunk[0] == 1 && chunk[1] == 1)) return false;
  Hdf5Block block{Hdf5Shape(chunk.size(), 0), dataset.shape};
  if (chunk.size() > 4) block.count[4] = static_cast<std::size_t>(views.channels());
  for (std::size_t& v = block.start[0]; v < dataset.shape[0]; v += chunk[0]) {
    progress.check();
    block.count[0] = std::min(chunk[0], dataset.shape[0] - v);
    file.read(name, block, views.view({static_cast<int>(v), 0}).data);
    progress.report(static_cast<double>(v + block.count[0]) /
                    static_cast<double>(dataset.shape[0]));
  }
  return true;
}

template bool read_rows_of_views(const Hdf5Input&, const std::string&, ViewStack<std::uint8_t>&,
                                 const Progress&);
template bool read_rows_of_views(const Hdf5Input&, const std::string&, ViewStack<std::int32_t>&,
                                 const Progress&);
template bool read_rows_of_views(const Hdf5Input&, const std::string&, ViewStack<std::uint16_t>&,
                                 const Progress&);
template bool read_rows_of_views(const Hdf5Input&, const std::string&, ViewStack<float>&,
                                 const Progress&);

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
    const Hdf5Block block =
        grid.count() > 1 ? view_block(shape, place) : Hdf5Block{Hdf5Shape(shape.size(), 0), shape};
    file.write(name, block, samples({maps.first.v + place.v, maps.first.u + place.u}));
    progress.report((i + 1.0) / grid.count());
  }
}

template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const std::uint8_t*(ViewIndex)>&);
template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const std::uint16_t*(ViewIndex)>&);
template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const std::int32_t*(ViewIndex)>&);
template void write_maps(Hdf5Output&, const std::string&, const MapGeometry&, const std::string&,
                         const Progress&, const std::function<const float*(ViewIndex)>&);

Image<float> marked_map(const DisparityView& map) {
  Image<float> marked(map.disparity.height, map.disparity.width);
  for (int y = 0; y < marked.height(); ++y) {
    for (int x = 0; x < marked.width(); ++x) {
      marked.at(y, x) =
          map.is_valid(y, x) ? map.disparity.at(y, x) : std::numeric_limits<float>::quiet_NaN();
    }
  }
  return marked;
}

void write_disparity(Hdf5Output& file, const std::string& name, const DisparityField& field,
                     const MapGeometry& maps, const Progress& progress) {
  Image<float> marked;
  write_maps<float>(file, name, maps, "px per view step", progress, [&](ViewIndex view) {
    marked = Image<float>(maps.height, maps.width);
    std::ranges::fill(marked, std::numeric_limits<float>::quiet_NaN());
    if (field.contains(view)) marked = marked_map(field.view(view));
    return marked.data();
  });
}

}  // namespace episcope::io
