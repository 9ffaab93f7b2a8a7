// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/label_meaning.h"

#include "engine/io/beside/class_table.h"
#include "engine/io/beside/map_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <unordered_map>
#include <utility>

namespace episcope::io {
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

/// The colour that most pixels of each label have.
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

/// What to add to stored ids to get the classes of UrbanLF, by their colours.
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
  meaning.kind = is_urban ? kUrbanKind : "coloured label maps";
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

}  // namespace episcope::io
