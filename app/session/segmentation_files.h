// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/segmentation.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace episcope {

/// Whether probabilities are written with the labels: four bytes for each ray and label.
enum class StoredProbabilities { None, All };

/// Writes labels with their names and colors, and probabilities, as `io::write_segmentation` does.
/// `input` is what opens the light field. A labeling without probabilities is written without.
/// Throws IoError, Cancelled.
void write_segmentation(const std::filesystem::path& path, const Segmentation& segmentation,
                        const std::string& input, StoredProbabilities probabilities,
                        const Progress& progress);

/// A view of a file that `write_segmentation` wrote, or of another file with LABELS: the middle one
/// unless another is asked for. Throws IoError, InvalidInput for a view that the file does not
/// hold.
[[nodiscard]] Segmentation read_segmentation(const std::filesystem::path& path,
                                             std::optional<ViewIndex> view);

/// A view of the first file of label probabilities of the archive that lies beside the light field;
/// its labels count from 1. Throws InvalidInput, naming the light field, if there is no such file
/// or view, IoError.
[[nodiscard]] LabelingPtr read_archive_probabilities(const Scene& scene, ViewIndex view);

/// Writes a mask of every label in every view that the segmentation covers, as 8-bit gray PNG, 255
/// where the pixel has the label, else 0: `folder/01_wall/mask_04_07.png` for label 1, “wall”, in
/// view (4, 7), row and column counted from 0. `labels.txt` beside them lists ids and names. Makes
/// the folders; files of the same names are replaced. Returns how many masks were written. Each
/// file is atomic. Throws IoError, Cancelled.
int write_label_masks(const std::filesystem::path& folder, const Segmentation& segmentation,
                      const Progress& progress);

/// The newest segmentation of a scene, kept with it.
struct KeptLabels {
  LabelingPtr labeling;          ///< Null while it is in its file only.
  std::vector<LabelInfo> infos;  ///< Names and colors.
  std::uint64_t strokes = 0;     ///< `hash_of` the strokes that it was learnt from.
  std::filesystem::path file{};  ///< That keeps it for the project; empty = none yet.

  [[nodiscard]] bool empty() const { return !labeling && file.empty(); }
  /// Whether all views are in memory, which take long to segment.
  [[nodiscard]] bool covers_many() const { return labeling && labeling->labels.grid().count() > 1; }
};

/// Hash of the pixels and labels of strokes.
[[nodiscard]] std::uint64_t hash_of(const ScribbleLayer& strokes);

/// Writes labels without their probabilities, which take four bytes for each ray and label. Throws
/// IoError, Cancelled.
void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress);

/// Reads what `write_kept_labels` wrote: it has no probabilities. Throws IoError, Cancelled.
[[nodiscard]] LabelingPtr read_kept_labels(const std::filesystem::path& path,
                                           const Progress& progress);

}  // namespace episcope
