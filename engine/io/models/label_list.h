// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"
#include "engine/io/base/hdf5_file.h"

#include <cstdint>
#include <limits>
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

/// Makes room for 0 as "none"; the largest number stays.
inline void raise_label(std::int32_t& label) {
  if (label < std::numeric_limits<std::int32_t>::max()) ++label;
}

}  // namespace episcope::io
