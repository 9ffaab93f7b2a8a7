// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/masks_beside.h"

#include "engine/core/error.h"
#include "engine/io/beside/map_file.h"

#include <algorithm>
#include <cstdint>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

Image<std::uint8_t> read_fitting_mask(const fs::path& path, const BesideViews& views) {
  Image<std::uint8_t> mask = read_mask(path);
  require_view_size(path, mask.height(), mask.width(), views);
  return mask;
}

void make_valid_mask(DisparityField& field) {
  if (!field.valid.empty()) return;
  const ViewStack<float>& like = field.disparity;
  field.valid = ViewStack<std::uint8_t>(like.grid(), like.height(), like.width(), 1, like.first());
  std::fill_n(field.valid.data(), field.valid.size(), std::uint8_t{1});
}

/// Clears pixels of a view; false, and nothing done, if no pixel would be left.
bool apply(const Image<std::uint8_t>& mask, bool marks_valid, ImageView<std::uint8_t> valid) {
  const auto keeps = [&](int i) { return (mask.data()[i] != 0) == marks_valid; };
  const int count = static_cast<int>(mask.size());
  bool is_left = false;
  for (int i = 0; i < count && !is_left; ++i) is_left = valid.data[i] != 0 && keeps(i);
  for (int i = 0; i < count && is_left; ++i) {
    if (!keeps(i)) valid.data[i] = 0;
  }
  return is_left;
}

void read_validity(const MapSet& set, const BesideViews& views, const BesideNotes& notes,
                   DisparityField& field) {
  SetOutcome outcome;
  const bool marks_valid = set.kind == MapKind::Valid;
  for (const MapSet::Entry& entry : set.entries) {
    const ViewIndex view = views.grid().view_at(entry.view);
    if (!field.contains(view)) {
      notes.account.leave_out({entry.file}, "masks of views without disparity");
      continue;
    }
    try {
      const Image<std::uint8_t> mask = read_fitting_mask(entry.file, views);
      make_valid_mask(field);
      if (!apply(mask, marks_valid, field.valid.view(view))) {
        throw IoError(entry.file,
                      "this mask would leave no pixel with a disparity; remove or replace it");
      }
      outcome.read.push_back(entry.file);
    } catch (const IoError& error) {
      outcome.failed.push_back(entry.file);
      if (outcome.first_error.empty()) outcome.first_error = error.what();
    }
  }
  outcome.tell(kind_text(set.kind), notes);
}

void read_region(const MapSet& set, const BesideViews& views, const BesideNotes& notes,
                 GroundTruth& truth) {
  SetOutcome outcome;
  const fs::path& path = set.entries.front().file;
  try {
    truth.regions.insert_or_assign(region_name(path.stem().string()),
                                   read_fitting_mask(path, views));
    outcome.read.push_back(path);
  } catch (const IoError& error) {
    outcome.failed.push_back(path);
    outcome.first_error = error.what();
  }
  outcome.tell(kind_text(set.kind), notes);
}

}  // namespace

void read_masks_beside(const std::vector<MapSet>& sets, const BesideViews& views,
                       const BesideNotes& notes, GroundTruth& truth) {
  for (const MapSet& set : sets) {
    if (set.entries.empty() || !can_hold_labels(set.entries.front().file)) continue;
    if (set.kind == MapKind::Valid || set.kind == MapKind::Invalid) {
      read_validity(set, views, notes, truth.field);
    } else if (set.kind == MapKind::Region && set.entries.size() == 1 &&
               set.entries.front().view == views.center()) {
      read_region(set, views, notes, truth);
    }
  }
}

}  // namespace episcope::io
