// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/labels/segmentation.h"

#include <filesystem>

namespace episcope {

/// Writes a mask of every label in every view that the segmentation covers, as 8-bit grey PNG, 255
/// where the pixel has the label, else 0: `folder/01_wall/mask_04_07.png` for label 1, “wall”, in
/// view (4, 7), row and column counted from 0. `labels.txt` beside them lists ids and names. Makes
/// the folders; files of the same names are replaced. Returns how many masks were written. Each
/// file is atomic. Throws IoError, Cancelled.
int write_label_masks(const std::filesystem::path& folder, const Segmentation& segmentation,
                      const Progress& progress);

}  // namespace episcope
