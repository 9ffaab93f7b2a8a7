// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/sidecar_labels.h"

#include "engine/core/error.h"
#include "engine/core/finding.h"
#include "engine/core/text.h"
#include "engine/io/base/files.h"
#include "engine/io/base/hdf5_file.h"
#include "engine/io/base/npy.h"
#include "engine/io/models/array_maps.h"
#include "engine/io/models/scribble_file.h"
#include "engine/io/models/sidecar_maps/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

bool is_picture(const MapSet& set) {
  return is_image_name(set.entries.front().file);
}

/// As in UrbanLF: 5_5.png, and 5_5_label.npy or label.npy.
bool has_urban_name(const MapSet& set, const SidecarViews& views) {
  if (views.files.files.empty()) return false;  // all in one picture
  const std::string view = numbered_name(views.files.files.front().stem().string()).text;
  const std::string labels = fs::path(set.pattern).stem().string();
  return view == "#_#" && (labels == "#_#_label" || labels == "label");
}

bool has_urban_size(const SidecarViews& views) {
  const bool is_real = views.width() == 623 && views.height() == 432;
  const bool is_rendered = views.width() == 640 && views.height() == 480;
  return is_real || is_rendered;
}

/// Colors of one view that `labels` holds too: of the center view, if it is among them.
ViewStack<std::int32_t> colors_from(const MapSet& pictures, const ViewStack<std::int32_t>& labels,
                                    const SidecarViews& views) {
  const GridShape grid = views.grid();
  MapSet::Entry entry = pictures.entries.front();
  const fs::path center = pictures.file_of(views.center());
  if (!center.empty()) entry = {views.center(), center};
  const ViewIndex at = grid.view_at(entry.view);
  if (!labels.contains(at)) return {};
  const MapSet one{pictures.kind, pictures.pattern, {entry}, {}};
  SetOutcome outcome;
  LabelMaps colors = read_label_set(one, views, outcome, Progress(1));
  return colors.are_colors ? std::move(colors.numbers) : ViewStack<std::int32_t>();
}

struct FoundLabels {
  LabelMaps maps;
  const MapSet* set = nullptr;
  SetOutcome outcome;
};

/// The first set of which a file can be read.
FoundLabels read_first_labels(const std::vector<const MapSet*>& sets, const SidecarViews& views,
                              const SidecarNotes& notes, const Progress& progress) {
  for (const MapSet* set : sets) {
    FoundLabels found;
    found.maps = read_label_set(*set, views, found.outcome, progress);
    if (!found.maps.numbers.empty()) {
      found.set = set;
      return found;
    }
    found.outcome.tell(kind_text(MapKind::Labels), notes);
  }
  return {};
}

/// What numbers mean, also by pictures of the same labels.
LabelMeaning name_with_pictures(FoundLabels& found, const std::vector<const MapSet*>& sets,
                                const SidecarViews& views, const SidecarNotes& notes) {
  LabelHints hints{has_urban_name(*found.set, views), has_urban_size(views), {}};
  const MapSet* twin = nullptr;
  for (const MapSet* set : sets) {
    if (set == found.set || !is_picture(*set) || !hints.colors.empty()) continue;
    hints.colors = colors_from(*set, found.maps.numbers, views);
    if (!hints.colors.empty()) twin = set;
  }
  LabelMeaning meaning = name_numbers(found.maps.numbers, hints);
  found.outcome.tell(meaning.kind, notes);
  if (twin != nullptr) notes.account.use(twin->files(), "label pictures");
  for (const MapSet* set : sets) {
    if (set != found.set && set != twin) tell_equal_names(*found.set, *set, notes.report);
  }
  return meaning;
}

void note_raise(const LabelMeaning& meaning, ConventionReport& report) {
  if (!meaning.raised) return;
  report.raised_labels = true;
  report.warnings.emplace_back(finding_text("labels.raised_files"));
}

}  // namespace

SidecarLabels read_sidecar_labels(const std::vector<MapSet>& sets, const SidecarViews& views,
                                  const SidecarNotes& notes, const Progress& progress) {
  RankedSets ranked = rank_sets(sets, MapKind::Labels, can_hold_labels);
  for (std::size_t tries = ranked.fit.size(); tries > 0; --tries) {
    FoundLabels found = read_first_labels(ranked.fit, views, notes, progress);
    if (found.set == nullptr) return {};
    LabelMeaning meaning;
    if (found.maps.are_colors) {
      auto named = name_colors(found.maps.numbers);
      if (!named) {
        notes.account.leave_out(found.set->files(), "pictures of more than 256 colors");
        std::erase(ranked.fit, found.set);
        continue;
      }
      meaning = std::move(*named);
      found.outcome.tell(meaning.kind, notes);
    } else {
      meaning = name_with_pictures(found, ranked.fit, views, notes);
    }
    note_raise(meaning, notes.report);
    return {std::move(found.maps.numbers), std::move(meaning.infos)};
  }
  return {};
}

namespace {

constexpr std::size_t kMostColors = 256;
constexpr std::int32_t kNone = 255;  ///< In bytes.
constexpr int kUrbanClasses = 14;
constexpr const char* kUrbanKind = "UrbanLF label maps";
constexpr int kMostInfos = 255;  ///< Ids that a user can paint with.

/// Distinct values and how often they occur; nothing if there are more than `most`.
std::optional<std::map<std::int32_t, std::size_t>> count_values(
    const ViewStack<std::int32_t>& labels, std::size_t most) {
  std::unordered_map<std::int32_t, std::size_t> counts;
  const std::int32_t* end = labels.data() + labels.size();
  for (const std::int32_t* run = labels.data(); run != end;) {
    const std::int32_t* next = std::find_if(run, end, [&](std::int32_t v) { return v != *run; });
    counts[*run] += static_cast<std::size_t>(next - run);
    if (counts.size() > most + 1) return std::nullopt;  // kNoMap is none of them
    run = next;
  }
  counts.erase(kNoMap);
  return std::map<std::int32_t, std::size_t>(counts.begin(), counts.end());
}

template <class Map>
void replace(ViewStack<std::int32_t>& labels, const Map& map) {
  std::transform(labels.data(), labels.data() + labels.size(), labels.data(), map);
}

void replace_by(ViewStack<std::int32_t>& labels, const std::map<std::int32_t, std::int32_t>& ids) {
  std::int32_t last = 0;
  std::int32_t id = ids.contains(0) ? ids.at(0) : 0;
  replace(labels, [&](std::int32_t color) {
    if (color != last) {
      last = color;
      id = ids.at(color);
    }
    return id;
  });
}

std::vector<LabelInfo> urban_infos() {
  return {urban_classes().begin(), urban_classes().end()};
}

/// The color that most pixels of each label have.
std::map<std::int32_t, std::int32_t> colors_of(const ViewStack<std::int32_t>& labels,
                                               const ViewStack<std::int32_t>& colors) {
  std::map<std::int32_t, std::int32_t> found;
  if (colors.empty() || !labels.contains(colors.first())) return found;
  const auto numbers = labels.view(colors.first());
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> counts;
  for (std::size_t i = 0; i < colors.size(); ++i) ++counts[{numbers.data[i], colors.data()[i]}];
  std::map<std::int32_t, std::size_t> most;
  for (const auto& [pair, count] : counts) {
    if (count <= most[pair.first]) continue;
    most[pair.first] = count;
    found[pair.first] = pair.second;
  }
  return found;
}

/// What to add to stored ids to get the classes of UrbanLF, by their colors.
std::optional<int> urban_offset(const std::map<std::int32_t, std::int32_t>& colors) {
  std::optional<int> offset;
  for (const auto& [id, color] : colors) {
    const int known = urban_class_of(unpacked(color));
    if (known == 0 || (offset && *offset != known - id)) return std::nullopt;
    offset = known - id;
  }
  return offset;
}

struct Stored {
  std::int32_t least = 0;
  std::int32_t most = 0;
  bool has_zero = false;
  bool has_other_none = false;  ///< −1 or 255 mark pixels without a label.
};

/// Replaces what marks pixels without a label by −1.
Stored mark_none(ViewStack<std::int32_t>& labels) {
  Stored stored;
  const auto end = labels.data() + labels.size();
  std::int32_t below = 0;  // the largest but 255
  bool has_none = false;
  std::for_each(labels.data(), end, [&](std::int32_t label) {
    if (label == kNoMap) return;
    stored.least = std::min(stored.least, label);
    stored.most = std::max(stored.most, label);
    if (label != kNone) below = std::max(below, label);
    has_none = has_none || label == kNone;
    stored.has_zero = stored.has_zero || label == 0;
  });
  const bool is_none = has_none && stored.most == kNone && below > 0;
  stored.has_other_none = is_none || stored.least < 0;
  if (is_none) stored.most = below;
  if (!stored.has_other_none) return stored;
  replace(labels, [&](std::int32_t label) {
    return label < 0 || (is_none && label == kNone) ? -1 : label;
  });
  return stored;
}

bool begins_at_zero(const Stored& stored, const LabelHints& hints, std::optional<int> offset,
                    const std::map<std::int32_t, std::int32_t>& colors) {
  if (offset) return *offset == 1;
  if (!stored.has_zero) return false;
  const auto zero = colors.find(0);
  if (zero != colors.end()) return zero->second != 0;  // black = none
  if (hints.is_urban_name && stored.most <= kUrbanClasses) return stored.most < kUrbanClasses;
  return stored.has_other_none;
}

std::vector<LabelInfo> infos_by_color(const std::map<std::int32_t, std::int32_t>& colors,
                                      int raise) {
  std::vector<LabelInfo> infos;
  for (const auto& [id, color] : colors) {
    const int raised = id + raise;
    if (id < 0 || raised < 1 || raised > kMostInfos) continue;
    infos.push_back({raised, fmt::format("label {}", raised), unpacked(color)});
  }
  return infos;
}

}  // namespace

std::optional<LabelMeaning> name_colors(ViewStack<std::int32_t>& labels) {
  const auto counts = count_values(labels, kMostColors);
  if (!counts) return std::nullopt;
  const bool is_urban = std::ranges::all_of(
      *counts, [](const auto& one) { return urban_class_of(unpacked(one.first)) > 0; });
  LabelMeaning meaning;
  std::map<std::int32_t, std::int32_t> ids;
  for (const auto& [color, count] : *counts) {
    const auto next = static_cast<std::int32_t>(meaning.infos.size()) + 1;
    ids[color] = is_urban ? urban_class_of(unpacked(color)) : color == 0 ? 0 : next;
    if (!is_urban && color != 0 && next <= kMostInfos) {
      meaning.infos.push_back({next, fmt::format("label {}", next), unpacked(color)});
    }
  }
  ids[kNoMap] = 0;
  replace_by(labels, ids);
  if (is_urban) meaning.infos = urban_infos();
  meaning.kind = is_urban ? kUrbanKind : "colored label maps";
  return meaning;
}

LabelMeaning name_numbers(ViewStack<std::int32_t>& labels, const LabelHints& hints) {
  const Stored stored = mark_none(labels);
  std::map<std::int32_t, std::int32_t> colors = colors_of(labels, hints.colors);
  colors.erase(-1);
  colors.erase(kNoMap);
  std::optional<int> offset = urban_offset(colors);
  if (offset && *offset != 0 && *offset != 1) offset.reset();
  LabelMeaning meaning;
  meaning.raised = begins_at_zero(stored, hints, offset, colors);
  const int raise = meaning.raised ? 1 : 0;
  replace(labels, [&](std::int32_t label) { return label < 0 ? 0 : label + raise; });
  const bool is_urban = offset || (hints.is_urban_name && hints.is_urban_size && colors.empty() &&
                                   stored.most + raise <= kUrbanClasses);
  meaning.infos = is_urban ? urban_infos() : infos_by_color(colors, raise);
  if (is_urban) meaning.kind = kUrbanKind;
  return meaning;
}

std::span<const LabelInfo> urban_classes() {
  static const std::vector<LabelInfo> classes{
      {1, "bike", {168, 198, 168}},       {2, "building", {198, 0, 0}},
      {3, "fence", {202, 154, 198}},      {4, "others", {0, 0, 0}},
      {5, "person", {100, 198, 198}},     {6, "pole", {198, 100, 0}},
      {7, "road", {52, 42, 198}},         {8, "sidewalk", {154, 52, 192}},
      {9, "traffic sign", {198, 0, 168}}, {10, "vegetation", {0, 198, 0}},
      {11, "vehicle", {198, 186, 90}},    {12, "bridge", {108, 107, 161}},
      {13, "rider", {156, 200, 26}},      {14, "sky", {158, 179, 202}}};
  return classes;
}

int urban_class_of(Rgb color) {
  const auto found = std::ranges::find(urban_classes(), color, &LabelInfo::color);
  return found == urban_classes().end() ? 0 : found->id;
}

namespace {

/// As far as the header tells.
bool may_hold_fractions(const fs::path& path) {
  if (suffix_of(path) == ".npy") return is_float(NpyFile(path).type());
  if (!has_hdf5_signature(path)) return false;
  const Hdf5Input file(path);
  return !file.has(kTrueLabels) &&
         std::ranges::any_of(file.datasets(), [](const Hdf5Dataset& dataset) {
           return dataset.type == Hdf5Type::Float;
         });
}

bool holds_fractions(const fs::path& path, GridShape grid) {
  try {
    if (is_archive_of_maps(path)) return holds_archived_fractions(path, grid);
    return may_hold_fractions(path) && has_fractions(read_values(path, grid).disparity);
  } catch (const IoError&) {
    return false;  // what is wrong with it is said when it is read
  }
}

}  // namespace

void settle_fractional_labels(std::vector<MapSet>& sets, const SidecarViews& views,
                              const SidecarNotes& notes) {
  const bool has_disparity = std::ranges::any_of(sets, [](const MapSet& set) {
    return set.kind == MapKind::Disparity && can_hold_values(set.entries.front().file);
  });
  std::erase_if(sets, [&](MapSet& set) {
    const bool is_disparity =
        set.kind == MapKind::Labels && holds_fractions(set.entries.front().file, views.grid());
    if (is_disparity && !has_disparity) {
      set.kind = MapKind::Disparity;
      set.is_named_labels = true;
    }
    if (is_disparity && has_disparity) {
      notes.account.leave_out(set.files(), "maps named like labels, but with fractions");
    }
    return is_disparity && has_disparity;
  });
}

}  // namespace episcope::io
