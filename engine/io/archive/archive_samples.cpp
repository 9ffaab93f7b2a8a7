// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/archive/archive_samples.h"

#include "engine/core/array/memory_budget.h"
#include "engine/io/archive/stored_views.h"
#include "engine/io/open/center_preview.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

template <class T>
ViewStack<T> read_views(const Hdf5Input& file, const ArchiveLayout& layout,
                        const std::function<void(ImageView<const T>)>& on_center,
                        const Progress& progress) {
  const FieldShape& shape = layout.shape;
  ViewStack<T> stack(shape.grid, shape.height, shape.width, layout.channels);
  const auto read = [&](ViewIndex view) {
    Hdf5Block block{
        {static_cast<std::size_t>(view.v), static_cast<std::size_t>(view.u), 0, 0},
        {1, 1, static_cast<std::size_t>(shape.height), static_cast<std::size_t>(shape.width)}};
    if (layout.has_channel_axis) {
      block.start.push_back(0);
      block.count.push_back(static_cast<std::size_t>(layout.channels));
    }
    file.read(kArchiveLightField, block, stack.view(view).data);
  };
  const ViewIndex center = shape.grid.center();
  progress.check();
  read(center);
  on_center(stack.view(center));
  if (shape.grid.count() > 1 && read_stored_views(file, kArchiveLightField, stack, progress)) {
    return stack;
  }
  for (int i = 0; i < shape.grid.count(); ++i) {
    progress.check();
    const ViewIndex view = shape.grid.view_at(i);
    if (!(view == center)) read(view);
    progress.report((i + 1.0) / shape.grid.count());
  }
  return stack;
}

/// Views that are better read from the file whenever they are looked at, if it stores them as they
/// are in memory. Floats are read: some of them may have to be changed.
template <class T>
std::optional<ViewStack<T>> map_views(const Hdf5Input& file, const ArchiveLayout& layout,
                                      const OpenOptions& options) {
  const FieldShape& shape = layout.shape;
  const Hdf5Shape stored = file.dataset(kArchiveLightField).shape;
  const bool has_all_channels =
      !layout.has_channel_axis || stored.back() == static_cast<std::size_t>(layout.channels);
  if (std::is_floating_point_v<T> || !has_all_channels || options.equalise ||
      !options.levels.empty())
    return std::nullopt;
  const std::size_t bytes = static_cast<std::size_t>(shape.grid.count()) * shape.height *
                            shape.width * layout.channels * sizeof(T);
  if (!is_better_mapped(static_cast<double>(bytes))) return std::nullopt;
  const auto offset = file.place_in_file<T>(kArchiveLightField);
  if (!offset) return std::nullopt;
  const auto map = [&](std::size_t size) { return large_part_of_file(file.path(), *offset, size); };
  return ViewStack<T>(shape.grid, shape.height, shape.width, layout.channels, {}, map);
}

}  // namespace

LightField::Samples read_archive_samples(const Hdf5Input& file, ArchiveLayout layout,
                                         const OpenOptions& options, const LightFieldInfo& info,
                                         const Progress& progress) {
  if (layout.type == Hdf5Type::Integer) {
    const ViewStack<std::uint16_t> probe = [&] {
      ArchiveLayout center = layout;
      center.shape.grid = {1, 1};
      return read_views<std::uint16_t>(
          file, center, [](const auto&) {}, Progress(1));
    }();
    const bool fits = std::all_of(probe.data(), probe.data() + probe.size(),
                                  [](std::uint16_t sample) { return sample <= 255; });
    layout.type = fits ? Hdf5Type::UInt8 : Hdf5Type::UInt16;
  }
  const auto read = [&]<class T>(T) -> LightField::Samples {
    const auto show = [&](ImageView<const T> center) {
      if (options.on_center_view) {
        options.on_center_view(preview_rgb(center), info, layout.shape.grid);
      }
    };
    if (auto mapped = map_views<T>(file, layout, options)) {
      show(mapped->view(mapped->grid().center()));
      return std::move(*mapped);
    }
    return read_views<T>(file, layout, show, progress);
  };
  if (layout.type == Hdf5Type::UInt8) return read(std::uint8_t{});
  if (layout.type == Hdf5Type::UInt16) return read(std::uint16_t{});
  return read(float{});
}

}  // namespace episcope::io
