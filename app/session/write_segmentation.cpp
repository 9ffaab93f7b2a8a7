// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/write_segmentation.h"

#include "app/session/run_labeler.h"
#include "engine/io/labels/labeling_file.h"

namespace episcope {

void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& source, const Progress& progress) {
  const Labeling& labeling = *segmentation.labeling;
  io::StoredLabeling stored;
  stored.labels = labeling.labels.clone();
  stored.infos = label_infos({{}, segmentation.labels}, labeling.probabilities.ids);
  stored.parameters = segmentation.parameters;
  stored.source = source;
  stored.seconds = labeling.seconds;
  io::write_labeling(
      path, stored,
      [&labeling](ViewIndex view) { return labeling.probabilities.view(view).view(); }, progress);
}

}  // namespace episcope
