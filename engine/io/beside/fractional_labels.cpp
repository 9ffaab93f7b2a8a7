// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/fractional_labels.h"

#include "engine/core/error.h"
#include "engine/core/text/suffix.h"
#include "engine/io/arrays/array_maps.h"
#include "engine/io/arrays/npy_file.h"
#include "engine/io/beside/archived_map.h"
#include "engine/io/beside/map_file.h"
#include "engine/io/hdf5/hdf5_file.h"
#include "engine/io/labels/label_list.h"

#include <algorithm>

namespace episcope::io {
namespace {

namespace fs = std::filesystem;

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

void settle_fractional_labels(std::vector<MapSet>& sets, const BesideViews& views,
                              const BesideNotes& notes) {
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
