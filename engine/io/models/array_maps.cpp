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
#include <cstddef>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace episcope::io {
namespace {

std::optional<MapKind> kind_of(const ArrayEntry& entry) {
  if (!entry.other_kind.empty()) return std::nullopt;
  const std::string name = telling_name(entry);
  const bool is_truth =
      is_bare_truth_name(name) && (is_float(entry.type) || lower_case(name) == "gt");
  return is_truth ? MapKind::Disparity : map_kind(name);
}

/// By its own name, else by those of the groups that it is in.
MapClaim claim_of(const ArrayEntry& entry) {
  const MapClaim own = map_claim(telling_name(entry));
  if (own != MapClaim::None) return own;
  return group_claim(entry.name.substr(0, entry.name.rfind('/') + 1));
}

enum class Pixels { AsViews, Exchanged };

/// Axes that a map beside this light field can have, each of at least the pixels.
std::vector<std::string> possible_axes(const ArrayLayout& light_field, IndexOrder order) {
  std::string all;
  for (const char letter : in_index_order(light_field.axes, order)) {
    if (letter != 'c' && letter != kSingle) all += letter;
  }
  std::string pixels;
  for (const char letter : all) {
    if (letter == 'y' || letter == 'x') pixels += letter;
  }
  return {all, pixels, "vuyx", "yx", "nyx"};
}

/// The light field's layout without the letters that a map of this shape lacks, and perhaps with
/// rows and columns of pixels exchanged. Axes of length 1 may precede or follow.
std::optional<ArrayLayout> map_layout(const ArrayEntry& entry, const ArrayLayout& light_field,
                                      IndexOrder order, Pixels are = Pixels::AsViews) {
  ArrayLayout layout{entry.shape, {}};
  const ArrayShape lengths = in_index_order(entry.shape, entry.order);
  const auto views = static_cast<std::size_t>(light_field.grid().count());
  for (const std::string& axes : possible_axes(light_field, order)) {
    if (axes.size() > lengths.size()) continue;
    const std::string singles(lengths.size() - axes.size(), kSingle);
    for (std::string whole : {singles + axes, axes + singles}) {
      if (are == Pixels::Exchanged) std::swap(whole[whole.find('y')], whole[whole.find('x')]);
      layout.axes = in_index_order(whole, entry.order);
      const auto fits = [&](std::size_t axis) {
        const char letter = whole[axis];
        if (letter == kSingle) return lengths[axis] == 1;
        return lengths[axis] == (letter == 'n' ? views : light_field.length(letter));
      };
      bool is_fit = true;
      for (std::size_t axis = 0; axis < whole.size(); ++axis) is_fit = is_fit && fits(axis);
      if (is_fit) return layout;
    }
  }
  return std::nullopt;
}

/// Maps of all views in a list, of a light field that is none, or a column.
bool is_list_of_maps(const ArrayLayout& maps, GridShape grid) {
  return maps.has('n') && !(maps.grid() == grid);
}

/// A map of one view belongs to the center, and those of a list to the views row by row.
template <class T>
ViewStack<T> read_maps(const ArrayInput& array, const ArrayLayout& layout, GridShape grid,
                       const Progress& progress) {
  ViewStack<T> maps = read_map_stack<T>(array, layout, progress);
  if (is_list_of_maps(layout, grid)) {
    ViewStack<T> placed(grid, maps.height(), maps.width());
    std::copy_n(maps.data(), maps.size(), placed.data());
    return placed;
  }
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

/// The arrays in the order in which they are taken: those named like labels last, since they may
/// hold disparity, which one that is called so knows better; those first that claim to be true.
std::vector<const ArrayEntry*> by_claim(std::vector<const ArrayEntry*> entries) {
  std::ranges::stable_sort(entries, {}, [](const ArrayEntry* entry) {
    return std::pair(kind_of(*entry) == MapKind::Labels, claim_of(*entry));
  });
  return entries;
}

/// Maps that are no truth by their names.
bool is_computed(const ArrayEntry& entry) {
  const auto kind = kind_of(entry);
  const bool is_truth =
      kind == MapKind::Disparity || kind == MapKind::Depth || kind == MapKind::Labels;
  return is_truth && claim_of(entry) == MapClaim::Computed;
}

/// By its name, or because floats may have fractions, which labels have not.
bool may_be_disparity(const ArrayEntry& entry, MapKind kind) {
  return kind == MapKind::Disparity || (kind == MapKind::Labels && is_float(entry.type));
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

/// A mask and the array that holds it.
struct NamedMask {
  ViewStack<std::uint8_t> mask;
  std::string name;
};

/// Of the pixels of which a disparity is known in views of the mask.
std::string lost_by(const NamedMask& named, const DisparityField& field) {
  std::size_t known = 0, lost = 0;
  for (int i = 0; i < field.disparity.grid().count(); ++i) {
    const ViewIndex view = field.disparity.view_at(i);
    if (!named.mask.contains(view)) continue;
    const DisparityView map = field.view(view);
    const auto mask = named.mask.view(view);
    for (int y = 0; y < mask.height; ++y) {
      for (int x = 0; x < mask.width; ++x) {
        if (!map.is_valid(y, x)) continue;
        ++known;
        lost += mask.at(y, x) == 0 ? 1 : 0;
      }
    }
  }
  return masked_text(named.name, lost, known);
}

/// Pixels where a mask of the same single view is 0 hold no disparity. A mask of values that are
/// missing, as NumPy writes them, tells nothing of the views either.
void use_masks(const NamedMask& of_one, NamedMask& of_all, ArrayMaps& maps) {
  DisparityField& field = maps.truth.field;
  for (const NamedMask* named : {&of_one, static_cast<const NamedMask*>(&of_all)}) {
    const ViewStack<std::uint8_t>& mask = named->mask;
    if (mask.empty() || field.empty()) continue;
    const bool is_alike = mask.size() == field.disparity.size();
    const bool is_turned = is_alike && marks_missing(mask, field);
    const std::string text = is_turned ? std::string() : lost_by(*named, field);
    if (!text.empty()) maps.notes.push_back(text);
    if (!is_alike) continue;
    if (is_turned || named == &of_one) mask_truth(mask, is_turned, field);
    if (!is_turned) continue;
    maps.notes.emplace_back(finding_text("map.mask_turned"));
    if (named != &of_one) of_all.mask = {};
  }
  maps.valid = std::move(of_all.mask);
}

constexpr const char* kDepthUnused = "depth maps, as no camera parameters are known";

/// Depth would need the camera, which arrays do not state.
FileUse not_used(const ArrayEntry& entry) {
  if (kind_of(entry) == MapKind::Depth) return {kDepthUnused, 1, entry.name, false};
  const std::string content = content_text(entry);
  return {entry.other_kind.empty() ? fmt::format(finding_text("dataset.array"), content) : content,
          1, entry.name, false};
}

/// Reads the arrays one after the other; keeps the first of each kind.
class MapReader {
 public:
  MapReader(const ArrayFile& file, const FieldAxes& light_field, bool wants_labels,
            const Progress& progress)
      : file_(file), light_field_(light_field), wants_labels_(wants_labels), progress_(progress) {}

  void read(const ArrayEntry& entry) {
    progress_.check();
    const auto kind = kind_of(entry);
    Fit fit;
    if (kind && !is_computed(entry)) fit = fit_of(entry);
    const auto used_as = fit.axes ? take(entry, *kind, *fit.axes) : std::nullopt;
    if (!used_as) return leave_out(entry, kind, fit.axes.has_value());
    maps_.uses.push_back({kind_text(*used_as), 1, entry.name, true});
    const ArrayLayout& axes = *fit.axes;
    if (fit.is_turned) {
      maps_.notes.push_back(fmt::format(finding_text("map.exchanged"), "The maps of " + entry.name,
                                        axes.height(), axes.width(), axes.width(), axes.height()));
    }
    if (is_list_of_maps(axes, grid())) {
      maps_.notes.push_back(
          fmt::format(finding_text("map.row_by_row"), grid().count(), entry.name));
    }
  }

  [[nodiscard]] ArrayMaps finish() && {
    if (maps_.truth.field.empty()) std::ranges::move(missed_, std::back_inserter(maps_.notes));
    use_masks(mask_of_one_, mask_of_all_, maps_);
    return std::move(maps_);
  }

 private:
  struct Fit {
    std::optional<ArrayLayout> axes{};
    bool is_turned = false;
  };

  [[nodiscard]] GridShape grid() const { return light_field_.layout.grid(); }

  [[nodiscard]] Fit fit_of(const ArrayEntry& entry) const {
    const auto& [layout, order] = light_field_;
    if (auto axes = map_layout(entry, layout, order)) return {std::move(axes)};
    return {map_layout(entry, layout, order, Pixels::Exchanged), true};
  }

  template <class T>
  [[nodiscard]] ViewStack<T> maps_of(const ArrayEntry& entry, const ArrayLayout& axes) const {
    return read_maps<T>(*file_.open(entry), axes, grid(), progress_);
  }

  /// What the array was read as; nothing if it is not used.
  std::optional<MapKind> take(const ArrayEntry& entry, MapKind kind, const ArrayLayout& axes) {
    if (may_be_disparity(entry, kind)) {
      ViewStack<float> values = maps_of<float>(entry, axes);
      if (kind == MapKind::Disparity || has_fractions(values)) {
        return take_disparity(entry, std::move(values));
      }
    }
    if (kind == MapKind::Labels) return take_labels(entry, axes);
    if (kind == MapKind::Valid || kind == MapKind::Invalid) return take_mask(entry, kind, axes);
    const bool is_region = kind == MapKind::Region && axes.grid().count() == 1;
    if (!is_region || !wants_labels_) return std::nullopt;
    const ViewStack<std::int32_t> numbers = maps_of<std::int32_t>(entry, axes);
    Image<std::uint8_t> region(numbers.height(), numbers.width());
    std::transform(numbers.data(), numbers.data() + numbers.size(), region.begin(),
                   [](std::int32_t number) { return static_cast<std::uint8_t>(number != 0); });
    maps_.truth.regions.insert_or_assign(region_name(telling_name(entry)), std::move(region));
    return kind;
  }

  std::optional<MapKind> take_disparity(const ArrayEntry& entry, ViewStack<float> values) {
    if (!maps_.truth.field.empty()) return left_for(maps_.disparity_name, entry);
    maps_.truth.field.disparity = std::move(values);
    mark_invalid(maps_.truth.field);
    maps_.disparity_name = entry.name;
    maps_.is_named_labels = kind_of(entry) == MapKind::Labels;
    disparity_claim_ = claim_of(entry);
    return MapKind::Disparity;
  }

  std::optional<MapKind> take_labels(const ArrayEntry& entry, const ArrayLayout& axes) {
    if (!labels_name_.empty()) return left_for(labels_name_, entry);
    labels_name_ = entry.name;
    labels_claim_ = claim_of(entry);
    if (wants_labels_) maps_.truth.labels = maps_of<std::int32_t>(entry, axes);
    return MapKind::Labels;
  }

  std::optional<MapKind> take_mask(const ArrayEntry& entry, MapKind kind, const ArrayLayout& axes) {
    const bool is_of_one = axes.grid().count() < grid().count();
    NamedMask& named = is_of_one ? mask_of_one_ : mask_of_all_;
    if (!named.mask.empty()) return std::nullopt;
    named = {mask_of(maps_of<std::int32_t>(entry, axes), kind), entry.name};
    return kind;
  }

  /// Another array of a kind is used already; which a note tells, unless its name claims more.
  std::optional<MapKind> left_for(const std::string& used, const ArrayEntry& entry) {
    const bool is_disparity = used == maps_.disparity_name;
    const bool is_named_so = (kind_of(entry) == MapKind::Disparity) == is_disparity;
    const MapClaim claim = is_disparity ? disparity_claim_ : labels_claim_;
    if (is_named_so && claim == claim_of(entry)) {
      maps_.notes.push_back(fmt::format(finding_text("map.equal_names"), used, entry.name));
    }
    return std::nullopt;
  }

  /// Says so where its name is that of truth.
  void leave_out(const ArrayEntry& entry, std::optional<MapKind> kind, bool fits) {
    const ArrayLayout& layout = light_field_.layout;
    maps_.uses.push_back(not_used(entry));
    if (!kind || !entry.other_kind.empty() || kind == MapKind::Region) return;
    const auto pixels = static_cast<std::size_t>(layout.height() * layout.width());
    if (element_count(entry.shape) < pixels) return;  // a range, or a scale
    if (is_computed(entry)) {
      maps_.uses.back().kind = "maps of methods, by their names";
      if (kind == MapKind::Disparity) {
        missed_.push_back(fmt::format(finding_text("map.computed_name"), entry.name));
      }
    } else if (!fits) {
      maps_.notes.push_back(fmt::format(finding_text("map.unfit_name"), entry.name,
                                        content_text(entry), grid().v, grid().u, layout.width(),
                                        layout.height()));
    } else if (kind == MapKind::Depth) {
      missed_.push_back(fmt::format(finding_text("map.unused"), entry.name, kDepthUnused));
    }
  }

  const ArrayFile& file_;
  const FieldAxes& light_field_;
  bool wants_labels_;
  const Progress& progress_;
  ArrayMaps maps_;
  NamedMask mask_of_one_, mask_of_all_;
  std::string labels_name_;
  MapClaim disparity_claim_ = MapClaim::None;
  MapClaim labels_claim_ = MapClaim::None;
  std::vector<std::string> missed_;  ///< Notes where no disparity is found.
};

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

std::string masked_text(const std::string& mask, std::size_t lost, std::size_t known) {
  constexpr double kTold = 0.05;
  const double share = known > 0 ? static_cast<double>(lost) / static_cast<double>(known) : 0;
  return share > kTold ? fmt::format(finding_text("map.masked"), mask, 100 * share) : std::string();
}

ArrayMaps read_array_maps(const ArrayFile& file, const std::vector<const ArrayEntry*>& others,
                          const FieldAxes& light_field, bool wants_labels,
                          const Progress& progress) {
  MapReader reader(file, light_field, wants_labels, progress);
  for (const ArrayEntry* entry : by_claim(others)) reader.read(*entry);
  return std::move(reader).finish();
}

ListedMaps list_array_maps(const std::vector<const ArrayEntry*>& others,
                           const FieldAxes& light_field) {
  ListedMaps listed;
  const int views = light_field.layout.grid().count();
  for (const ArrayEntry* entry : by_claim(others)) {
    const auto kind = is_computed(*entry) ? std::nullopt : kind_of(*entry);
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
