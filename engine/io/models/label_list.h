// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"
#include "engine/io/base/hdf5_file.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace episcope::io {

/// Dataset of the true labels.
inline constexpr const char* kTrueLabels = "GT_LABELS";

/// Files that may hold the labels of an archive file beside it, where they are looked for in this
/// order: `<stem>_labels.h5`, then `labels.h5`; of `lf.h5` only the latter.
[[nodiscard]] std::vector<std::filesystem::path> label_files_of(const std::filesystem::path& file);

/// The first of these that holds true labels or scribbles; `labels.h5` if none does, whether it is
/// there or not.
[[nodiscard]] std::filesystem::path labels_beside(const std::filesystem::path& file);

/// Reads names and colors of labels from attributes of a dataset, which other readers ignore:
/// `label_ids`, `label_names` (one per line), `label_colors` (R, G, B each). Empty if the
/// attributes are missing or inconsistent.
[[nodiscard]] std::vector<LabelInfo> read_label_list(const Hdf5Input& file,
                                                     const std::string& dataset);

/// Writes the attributes that `read_label_list` reads. Throws IoError.
void add_label_list(Hdf5Output& file, const std::string& dataset,
                    const std::vector<LabelInfo>& labels);

/// Raises a label by one, to make room for 0 = "none". The largest integer stays.
inline void raise_label(std::int32_t& label) {
  if (label < std::numeric_limits<std::int32_t>::max()) ++label;
}

}  // namespace episcope::io
