// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/labels_beside.h"

#include "engine/core/error.h"
#include "engine/io/beside/label_meaning.h"
#include "engine/io/beside/map_file.h"
#include "engine/io/grid/decode_image.h"

#include <algorithm>
#include <utility>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

bool is_picture(const MapSet& set) {
  return is_image_name(set.entries.front().file);
}

/// As in UrbanLF: 5_5.png, and 5_5_label.npy or label.npy.
bool has_urban_name(const MapSet& set, const BesideViews& views) {
  if (views.files.files.empty()) return false;  // all in one picture
  const std::string view = numbered_name(views.files.files.front().stem().string()).text;
  const std::string labels = fs::path(set.pattern).stem().string();
  return view == "#_#" && (labels == "#_#_label" || labels == "label");
}

bool has_urban_size(const BesideViews& views) {
  const bool is_real = views.width() == 623 && views.height() == 432;
  const bool is_rendered = views.width() == 640 && views.height() == 480;
  return is_real || is_rendered;
}

/// Colours of one view that `labels` holds too: of the centre view, if it is among them.
ViewStack<std::int32_t> colors_from(const MapSet& pictures, const ViewStack<std::int32_t>& labels,
                                    const BesideViews& views) {
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

struct Found {
  LabelMaps maps;
  const MapSet* set = nullptr;
  SetOutcome outcome;
};

/// The first set of which a file can be read.
Found read_first(const std::vector<const MapSet*>& sets, const BesideViews& views,
                 const BesideNotes& notes, const Progress& progress) {
  for (const MapSet* set : sets) {
    Found found;
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
LabelMeaning name_with_pictures(Found& found, const std::vector<const MapSet*>& sets,
                                const BesideViews& views, const BesideNotes& notes) {
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
  return meaning;
}

void note_raise(const LabelMeaning& meaning, ConventionReport& report) {
  if (!meaning.raised) return;
  report.raised_labels = true;
  report.warnings.push_back(
      "Labels start at 0 in these files: all labels are raised by one, so that 0 means none.");
}

}  // namespace

LabelsBeside read_labels_beside(const std::vector<MapSet>& sets, const BesideViews& views,
                                const BesideNotes& notes, const Progress& progress) {
  RankedSets ranked = rank_sets(sets, MapKind::Labels, can_hold_labels);
  for (std::size_t tries = ranked.fit.size(); tries > 0; --tries) {
    Found found = read_first(ranked.fit, views, notes, progress);
    if (found.set == nullptr) return {};
    LabelMeaning meaning;
    if (found.maps.are_colors) {
      auto named = name_colors(found.maps.numbers);
      if (!named) {
        notes.account.leave_out(found.set->files(), "pictures of more than 256 colours");
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

}  // namespace episcope::io
