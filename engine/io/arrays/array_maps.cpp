// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/arrays/array_maps.h"

#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_samples.h"
#include "engine/io/maps/foreign_result.h"

#include <algorithm>
#include <optional>

namespace episcope::io {
namespace {

enum class MapKind { None, Disparity, Labels, Mask };

MapKind kind_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string name = lower_case(slash == std::string::npos ? path : path.substr(slash + 1));
  const auto has = [&](const char* word) { return name.find(word) != std::string::npos; };
  if (has("valid") || has("mask")) return MapKind::Mask;
  if (has("label") || has("seg")) return MapKind::Labels;
  if (has("disp") || name == "gt") return MapKind::Disparity;
  return MapKind::None;
}

/// The light field's layout without the letters that a map of this shape lacks.
std::optional<ArrayLayout> map_layout(const ArrayEntry& entry, const ArrayLayout& light_field,
                                      IndexOrder order) {
  ArrayLayout layout{entry.shape, {}};
  ArrayShape shape;
  std::string all;
  for (const char letter : in_index_order(light_field.axes, order)) {
    if (letter != 'c') all += letter;
  }
  std::string pixels;
  for (const char letter : all) {
    if (letter == 'y' || letter == 'x') pixels += letter;
  }
  for (const std::string& axes : {all, pixels, std::string("vuyx"), std::string("yx")}) {
    layout.axes = in_index_order(axes, entry.order);
    if (layout.axes.size() != entry.shape.size()) continue;
    const auto fits = [&](char letter) {
      return layout.length(letter) == light_field.length(letter);
    };
    if (std::ranges::all_of(axes, fits)) return layout;
  }
  return std::nullopt;
}

/// A map of one view belongs to the centre.
template <class T>
ViewStack<T> read_maps(const ArrayInput& array, const ArrayLayout& layout, GridShape grid,
                       const Progress& progress) {
  ViewStack<T> maps = read_map_stack<T>(array, layout, progress);
  if (maps.grid().count() > 1 || grid.count() == 1) return maps;
  ViewStack<T> center({1, 1}, maps.height(), maps.width(), 1, grid.center());
  std::copy_n(maps.data(), maps.size(), center.data());
  return center;
}

ViewStack<std::uint8_t> mask_of(const ViewStack<std::int32_t>& numbers) {
  ViewStack<std::uint8_t> mask(numbers.grid(), numbers.height(), numbers.width(), 1,
                               numbers.first());
  std::transform(numbers.data(), numbers.data() + numbers.size(), mask.data(),
                 [](std::int32_t number) { return static_cast<std::uint8_t>(number != 0); });
  return mask;
}

}  // namespace

ArrayMaps read_array_maps(const ArrayFile& file, const ArrayEntry& light_field,
                          const ArrayLayout& layout, bool wants_labels, const Progress& progress) {
  ArrayMaps maps;
  const GridShape grid = layout.grid();
  for (const ArrayEntry& entry : file.entries()) {
    if (&entry == &light_field) continue;
    progress.check();
    const bool is_array = entry.other_kind.empty();
    MapKind kind = is_array ? kind_of(entry.name) : MapKind::None;
    const auto axes = is_array ? map_layout(entry, layout, light_field.order) : std::nullopt;
    const bool is_whole = axes && axes->grid().count() == grid.count();
    if (!axes) kind = MapKind::None;
    if (kind == MapKind::Disparity && maps.truth.field.empty()) {
      maps.truth.field.disparity = read_maps<float>(*file.open(entry), *axes, grid, progress);
      mark_invalid(maps.truth.field);
      maps.uses.push_back({"disparity (" + entry.name + ")", 1, entry.name, true});
    } else if (kind == MapKind::Labels && maps.truth.labels.empty()) {
      if (wants_labels) {
        maps.truth.labels = read_maps<std::int32_t>(*file.open(entry), *axes, grid, progress);
      }
      maps.uses.push_back({"labels (" + entry.name + ")", 1, entry.name, true});
    } else if (kind == MapKind::Mask && is_whole && maps.valid.empty()) {
      maps.valid = mask_of(read_maps<std::int32_t>(*file.open(entry), *axes, grid, progress));
      maps.uses.push_back({"mask of valid pixels (" + entry.name + ")", 1, entry.name, true});
    } else {
      const std::string what =
          is_array ? "array of " + array_shape_text(in_index_order(entry.shape, entry.order))
                   : entry.other_kind;
      maps.uses.push_back({what, 1, entry.name, false});
    }
  }
  return maps;
}

}  // namespace episcope::io
