// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/beside/beside.h"

#include "engine/io/beside/disparity_beside.h"
#include "engine/io/beside/fractional_labels.h"
#include "engine/io/beside/labels_beside.h"
#include "engine/io/beside/map_file.h"
#include "engine/io/beside/masks_beside.h"

#include <utility>

namespace episcope::io {

namespace {

/// Removes what is no truth, or belongs to no view, from the sets.
void set_aside(std::vector<MapSet>& sets, const BesideNotes& notes) {
  for (MapSet& set : sets) {
    notes.account.leave_out(set.strays, std::string(kind_text(set.kind)) + " of no view");
    notes.account.leave_out(set.of_left_out,
                            std::string(kind_text(set.kind)) + " of views left out");
    set.strays.clear();
    std::erase_if(set.entries, [&](const MapSet::Entry& entry) {
      const OwnFile own = own_file(entry.file);
      if (own == OwnFile::Scribbles) notes.account.use(entry.file, "scribble files");
      if (own == OwnFile::Segmentation) notes.account.leave_out({entry.file}, "segmentations");
      if (own == OwnFile::Result) notes.account.leave_out({entry.file}, "results");
      return own != OwnFile::None;
    });
  }
  std::erase_if(sets, [](const MapSet& set) { return set.entries.empty(); });
}

}  // namespace

FoundBeside read_beside(const BesideViews& views, const BesideNotes& notes,
                        const Progress& progress) {
  MapsBeside maps = find_maps(views.files, views.folder, views.is_own);
  FoundBeside found{{}, {}, views.camera};
  if (maps.sets.empty()) return found;
  progress.step("reading truth");
  for (const std::filesystem::path& folder : maps.folders) notes.account.add_folder(folder);
  set_aside(maps.sets, notes);
  settle_fractional_labels(maps.sets, views, notes);
  DisparityBeside disparity = read_disparity_beside(maps.sets, views, notes, progress.part(0, 0.6));
  found.truth.field = std::move(disparity.field);
  found.camera = disparity.camera;
  found.is_sign_assumed = disparity.is_sign_assumed;
  if (!views.needs_truth) return found;
  LabelsBeside labels = read_labels_beside(maps.sets, views, notes, progress.part(0.6, 0.9));
  found.truth.labels = std::move(labels.labels);
  found.label_infos = std::move(labels.infos);
  read_masks_beside(maps.sets, views, notes, found.truth);
  return found;
}

}  // namespace episcope::io
