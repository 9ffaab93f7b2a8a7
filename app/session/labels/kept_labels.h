// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/segmentation.h"

#include <cstdint>
#include <filesystem>

namespace episcope {

/// The newest segmentation of a scene, kept with it.
struct KeptLabels {
  LabelingPtr labeling;          ///< Null while it is in its file only.
  std::vector<LabelInfo> infos;  ///< Names and colours.
  std::uint64_t strokes = 0;     ///< `hash_of` the strokes that it was learnt from.
  std::filesystem::path file{};  ///< That keeps it for the project; empty = none yet.

  [[nodiscard]] bool empty() const { return !labeling && file.empty(); }
  /// Whether all views are in memory, which take long to segment.
  [[nodiscard]] bool covers_many() const { return labeling && labeling->labels.grid().count() > 1; }
};

/// Tells strokes with different pixels or labels apart.
[[nodiscard]] std::uint64_t hash_of(const ScribbleLayer& strokes);

/// Writes labels without their probabilities, which take four bytes for each ray and label. Throws
/// IoError, Cancelled.
void write_kept_labels(const std::filesystem::path& path, const KeptLabels& labels,
                       const std::string& input, const Progress& progress);

/// Reads what `write_kept_labels` wrote: it has no probabilities. Throws IoError, Cancelled.
[[nodiscard]] LabelingPtr read_kept_labels(const std::filesystem::path& path,
                                           const Progress& progress);

}  // namespace episcope
