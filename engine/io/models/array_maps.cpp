// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/array_maps.h"

#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/models/array_samples.h"
#include "engine/io/models/external_result.h"
#include "engine/io/models/sidecar_maps/disparity_units.h"
#include "engine/io/models/sidecar_maps/map_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

std::optional<MapKind> kind_of(const ArrayEntry& entry) {
  if (!entry.other_kind.empty()) return std::nullopt;
  const std::string name = telling_name(entry);
  if (lower_case(name) == "gt") return MapKind::Disparity;
  return map_kind(name);
}

enum class Pixels { AsViews, Exchanged };

/// The light field's layout without the letters that a map of this shape lacks, and perhaps with
/// rows and columns of pixels exchanged.
std::optional<ArrayLayout> map_layout(const ArrayEntry& entry, const ArrayLayout& light_field,
                                      IndexOrder order, Pixels are = Pixels::AsViews) {
  ArrayLayout layout{entry.shape, {}};
  std::string all;
  for (const char letter : in_index_order(light_field.axes, order)) {
    if (letter != 'c' && letter != kSingle) all += letter;
  }
  std::string pixels;
  for (const char letter : all) {
    if (letter == 'y' || letter == 'x') pixels += letter;
  }
  const ArrayShape lengths = in_index_order(entry.shape, entry.order);
  for (const std::string& axes : {all, pixels, std::string("vuyx"), std::string("yx")}) {
    std::string whole = axes;
    while (whole.size() < lengths.size() && lengths[lengths.size() - whole.size() - 1] == 1) {
      whole = kSingle + whole;
    }
    if (are == Pixels::Exchanged) std::swap(whole[whole.find('y')], whole[whole.find('x')]);
    layout.axes = in_index_order(whole, entry.order);
    if (layout.axes.size() != entry.shape.size()) continue;
    const auto fits = [&](char letter) {
      return layout.length(letter) == light_field.length(letter);
    };
    if (std::ranges::all_of(axes, fits)) return layout;
  }
  return std::nullopt;
}

/// A map of one view belongs to the center.
template <class T>
ViewStack<T> read_maps(const ArrayInput& array, const ArrayLayout& layout, GridShape grid,
                       const Progress& progress) {
  ViewStack<T> maps = read_map_stack<T>(array, layout, progress);
  if (maps.grid().count() > 1 || grid.count() == 1) return maps;
  ViewStack<T> center({1, 1}, maps.height(), maps.width(), 1, grid.center());
  std::copy_n(maps.data(), maps.size(), center.data());
  return center;
}

ViewStack<std::uint8_t> mask_of(const ViewStack<std::int32_t>& numbers, MapKind kind) {
  ViewStack<std::uint8_t> mask(numbers.grid(), numbers.height(), numbers.width(), 1,
                               numbers.first());
  std::transform(numbers.data(), numbers.data() + numbers.size(), mask.data(),
                 [&](std::int32_t number) {
                   return static_cast<std::uint8_t>((number != 0) == (kind == MapKind::Valid));
                 });
  return mask;
}

/// The arrays with those last that are named like labels: they may hold disparity, which one that
/// is called so knows better.
std::vector<const ArrayEntry*> labels_last(std::vector<const ArrayEntry*> entries) {
  std::stable_partition(entries.begin(), entries.end(),
                        [](const ArrayEntry* entry) { return kind_of(*entry) != MapKind::Labels; });
  return entries;
}

/// By its name, or because floats may have fractions, which labels have not.
bool may_be_disparity(const ArrayEntry& entry, MapKind kind) {
  return kind == MapKind::Disparity || (kind == MapKind::Labels && is_float(entry.type));
}

void take_disparity(const ArrayEntry& entry, ViewStack<float> values, ArrayMaps& maps) {
  maps.truth.field.disparity = std::move(values);
  mark_invalid(maps.truth.field);
  maps.disparity_name = entry.name;
  maps.is_named_labels = kind_of(entry) == MapKind::Labels;
}

/// Whether only pixels where the mask is 0 hold values, of which there are several.
bool marks_missing(const ViewStack<std::uint8_t>& mask, const DisparityField& field) {
  std::array<std::pair<float, float>, 2> range;
  range.fill({std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()});
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float value = field.disparity.data()[i];
    if (!field.valid.empty() && field.valid.data()[i] == 0) continue;
    auto& [least, most] = range[mask.data()[i] != 0 ? 1 : 0];
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return range[1].first >= range[1].second && range[0].first < range[0].second;
}

void mask_truth(const ViewStack<std::uint8_t>& mask, bool is_turned, DisparityField& field) {
  field.require_mask();
  std::transform(mask.data(), mask.data() + mask.size(), field.valid.data(), field.valid.data(),
                 [&](std::uint8_t a, std::uint8_t b) {
                   return static_cast<std::uint8_t>((a != 0) != is_turned && b != 0);
                 });
}

/// Pixels where a mask of the same single view is 0 hold no disparity. A mask of values that are
/// missing, as NumPy writes them, tells nothing of the views either.
void use_masks(const ViewStack<std::uint8_t>& mask_of_one, ArrayMaps& maps) {
  DisparityField& field = maps.truth.field;
  const ViewStack<std::uint8_t>* const masks[] = {&mask_of_one, &maps.valid};
  for (const ViewStack<std::uint8_t>* mask : masks) {
    if (mask->empty() || mask->size() != field.disparity.size()) continue;
    const bool is_turned = marks_missing(*mask, field);
    if (is_turned || mask == &mask_of_one) mask_truth(*mask, is_turned, field);
    if (!is_turned) continue;
    maps.notes.emplace_back(finding_text("map.mask_turned"));
    if (mask != &mask_of_one) maps.valid = {};
  }
}

/// Depth would need the camera, which arrays do not state.
FileUse not_used(const ArrayEntry& entry) {
  if (kind_of(entry) == MapKind::Depth) {
    return {"depth maps, as no camera parameters are known", 1, entry.name, false};
  }
  const std::string content = content_text(entry);
  return {entry.other_kind.empty() ? "array of " + content : content, 1, entry.name, false};
}

/// Whether the sign is known.
bool settle_stored(const LightField::Samples& samples, NamedValues values,
                   ConventionReport& report) {
  DisparityField& field = values.field;
  const GridShape grid = grid_of(samples);
  const int width = std::visit([](const auto& stack) { return stack.width(); }, samples);
  const ViewIndex at = told_view(field, grid);
  const SettledUnit settled = infer_units(samples, common_units(grid, width), values, report);
  const double factor = settled.unit.factor;
  OcclusionOrder side;
  if (settled.explanation.is_good()) {
    side = find_occlusion_order(samples, at, field.view(at), factor, settled.explanation);
  }
  const TruthSign sign = find_truth_sign(samples, side, settled.explanation);
  scale_values(field, sign.is_negated ? -factor : factor);
  report.units = fmt::format("disparity of {}: {}{}", values.name, settled.unit.text,
                             sign.is_negated ? ", negative = nearer" : "");
  report.units_check =
      fmt::format(finding_text("units.warp"), fmt::format("{:.2f}", settled.explanation.error),
                  fmt::format("{:.2f}", settled.explanation.unwarped));
  if (!sign.evidence.empty()) report.units_check += "; " + sign.evidence;
  return sign.is_known;
}

}  // namespace

std::string ArrayMaps::disparity_text() const {
  return is_named_labels ? fmt::format("{} ({})", disparity_name, kNamedLabels) : disparity_name;
}

bool has_fractions(const ViewStack<float>& values) {
  return std::any_of(values.data(), values.data() + values.size(), [](float value) {
    return std::isfinite(value) && value != std::trunc(value);
  });
}

ArrayMaps read_array_maps(const ArrayFile& file, const std::vector<const ArrayEntry*>& others,
                          const FieldAxes& light_field, bool wants_labels,
                          const Progress& progress) {
  ArrayMaps maps;
  ViewStack<std::uint8_t> mask_of_one;
  const ArrayLayout& layout = light_field.layout;
  const GridShape grid = layout.grid();
  for (const ArrayEntry* other : labels_last(others)) {
    const ArrayEntry& entry = *other;
    progress.check();
    auto kind = kind_of(entry);
    auto axes = kind ? map_layout(entry, layout, light_field.order) : std::nullopt;
    const bool is_turned = kind && !axes;
    if (is_turned) axes = map_layout(entry, layout, light_field.order, Pixels::Exchanged);
    const bool is_mask = kind == MapKind::Valid || kind == MapKind::Invalid;
    const bool is_of_one = axes && axes->grid().count() < grid.count();
    ViewStack<std::uint8_t>& mask = is_of_one ? mask_of_one : maps.valid;
    ViewStack<float> values;
    if (axes && may_be_disparity(entry, *kind)) {
      values = read_maps<float>(*file.open(entry), *axes, grid, progress);
      const bool is_labels = kind == MapKind::Labels && !has_fractions(values);
      kind = is_labels ? MapKind::Labels : MapKind::Disparity;
    }
    if (axes && kind == MapKind::Disparity && maps.truth.field.empty()) {
      take_disparity(entry, std::move(values), maps);
    } else if (axes && kind == MapKind::Labels && maps.truth.labels.empty()) {
      if (wants_labels) {
        maps.truth.labels = read_maps<std::int32_t>(*file.open(entry), *axes, grid, progress);
      }
    } else if (axes && is_mask && mask.empty()) {
      mask = mask_of(read_maps<std::int32_t>(*file.open(entry), *axes, grid, progress), *kind);
    } else {
      maps.uses.push_back(not_used(entry));
      continue;
    }
    maps.uses.push_back({kind_text(*kind), 1, entry.name, true});
    if (is_turned) {
      maps.notes.push_back(fmt::format(finding_text("map.exchanged"), "The maps of " + entry.name,
                                       axes->height(), axes->width(), axes->width(),
                                       axes->height()));
    }
  }
  use_masks(mask_of_one, maps);
  return maps;
}

ListedMaps list_array_maps(const std::vector<const ArrayEntry*>& others,
                           const FieldAxes& light_field) {
  ListedMaps listed;
  const int views = light_field.layout.grid().count();
  for (const ArrayEntry* entry : labels_last(others)) {
    const auto kind = kind_of(*entry);
    const auto axes =
        kind ? map_layout(*entry, light_field.layout, light_field.order) : std::nullopt;
    if (!axes) continue;
    const char* extent = axes->grid().count() == views ? "of all views" : "of one view";
    if (may_be_disparity(*entry, *kind)) {
      if (listed.disparity.empty()) listed.disparity = fmt::format("disparity {}", extent);
    } else if (kind == MapKind::Labels && listed.labels.empty()) {
      listed.labels = fmt::format("labels {}", extent);
    }
  }
  return listed;
}

void settle_disparity(const LightField::Samples& samples, ArrayMaps& maps, DisparityField& field,
                      ConventionReport& report) {
  if (field.empty()) return;
  maps.is_sign_assumed = !settle_stored(samples, {field, maps.disparity_text()}, report);
}

}  // namespace episcope::io
