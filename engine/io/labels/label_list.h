// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/label_info.h"
#include "engine/io/hdf5/hdf5_file.h"

#include <string>
#include <vector>

namespace episcope::io {

/// The dataset of true labels.
inline constexpr const char* kTrueLabels = "GT_LABELS";

/// Names and colours of labels, stored in attributes of a dataset that other readers ignore:
/// `label_ids`, `label_names` (one per line), `label_colors` (R, G, B each). None if there are no
/// such attributes or they do not fit together.
[[nodiscard]] std::vector<LabelInfo> read_label_list(const Hdf5Input& file,
                                                     const std::string& dataset);

/// Throws IoError.
void add_label_list(Hdf5Output& file, const std::string& dataset,
                    const std::vector<LabelInfo>& labels);

}  // namespace episcope::io
