// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/labels/save_masks.h"

#include "app/session/save/file_name.h"
#include "engine/io/durable/atomic_file.h"
#include "engine/io/durable/make_folder.h"
#include "engine/io/grid/image_file.h"
#include "engine/labeling/review/label_mask.h"

#include <fmt/format.h>

#include <span>

namespace episcope {
namespace {

namespace fs = std::filesystem;

fs::path folder_of(const LabelInfo& label, const fs::path& folder) {
  return folder / file_name_of(fmt::format("{:02}_{}", label.id, label.name));
}

void write_list(const fs::path& folder, const std::vector<LabelInfo>& labels) {
  std::string text;
  for (const LabelInfo& label : labels) text += fmt::format("{}\t{}\n", label.id, label.name);
  io::write_atomically(folder / "labels.txt", text);
}

}  // namespace

int write_label_masks(const fs::path& folder, const Segmentation& segmentation,
                      const Progress& progress) {
  const Labeling& labeling = *segmentation.labeling;
  const std::vector<LabelInfo> infos = infos_of(labeling.probabilities.ids, segmentation.labels);
  io::make_folder(folder);
  for (const LabelInfo& label : infos) io::make_folder(folder_of(label, folder));
  write_list(folder, infos);
  const GridShape grid = labeling.labels.grid();
  int written = 0;
  for (int i = 0; i < grid.count(); ++i) {
    progress.report(static_cast<double>(i) / grid.count());
    const ViewIndex view = grid.view_at(i, labeling.labels.first());
    const Image<std::int32_t> labels = finished_labels(labeling, segmentation.finish, view);
    for (const LabelInfo& label : infos) {
      progress.check();
      io::write_png(folder_of(label, folder) / fmt::format("mask_{:02}_{:02}.png", view.v, view.u),
                    label_mask(labels, label.id).view());
      ++written;
    }
  }
  return written;
}

}  // namespace episcope
