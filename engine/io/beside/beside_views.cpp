// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/beside_views.h"

#include "engine/core/error.h"
#include "engine/io/beside/text_map.h"
#include "engine/io/grid/decode_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

/// Sets are not mixed with regard to suffixes: these are part of their pattern.
fs::path first_file(const MapSet& set) {
  if (!set.entries.empty()) return set.entries.front().file;
  return set.strays.empty() ? set.of_left_out.front() : set.strays.front();
}

}  // namespace

int BesideViews::height() const {
  return std::visit([](const auto& stack) { return stack.height(); }, samples);
}

int BesideViews::width() const {
  return std::visit([](const auto& stack) { return stack.width(); }, samples);
}

void SetOutcome::tell(const std::string& kind, const BesideNotes& notes) const {
  notes.account.use(read, kind);
  if (!note.empty() && !read.empty()) notes.report.warnings.push_back(note);
  if (failed.empty()) return;
  notes.account.leave_out(failed, kind + " that are damaged or do not fit");
  notes.report.warnings.push_back(fmt::format("{} of {} {} are left out. {}.", failed.size(),
                                              read.size() + failed.size(), kind, first_error));
}

void require_view_size(const fs::path& path, int height, int width, const BesideViews& views) {
  if (height == views.height() && width == views.width()) return;
  throw IoError(path, fmt::format("this map has {}×{} px, but the views have {}×{} px; remove or "
                                  "replace it",
                                  width, height, views.width(), views.height()));
}

std::vector<MapSet::Entry> entries_to_read(const MapSet& set, const BesideViews& views) {
  if (views.map_views == MapViews::All || set.entries.size() < 2) return set.entries;
  const auto center = std::ranges::find(set.entries, views.center(), &MapSet::Entry::view);
  return {center == set.entries.end() ? set.entries.front() : *center};
}

RankedSets rank_sets(const std::vector<MapSet>& sets, MapKind kind,
                     bool (*can_hold)(const fs::path&)) {
  RankedSets ranked;
  for (const MapSet& set : sets) {
    if (set.kind != kind) continue;
    const bool is_fit = !set.entries.empty() && can_hold(first_file(set));
    (is_fit ? ranked.fit : ranked.unfit).push_back(&set);
  }
  std::ranges::stable_sort(ranked.fit, [](const MapSet* a, const MapSet* b) {
    const auto rank = [](const MapSet* set) {
      const fs::path file = first_file(*set);
      return std::tuple(-static_cast<int>(set->entries.size()), is_image_name(file),
                        has_text_suffix(file));
    };
    return rank(a) < rank(b);
  });
  return ranked;
}

}  // namespace episcope::io
