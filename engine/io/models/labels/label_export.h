// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/schema.h"
#include "engine/io/models/labels/label_import.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Folders in which other programs read labels. Views are named like the files of the light field
/// (`label_places`), else by row and column: `04_04`.
enum class LabelForm {
  Indexed,  ///< `04_04.png`, whose pixels are ids, with a palette; `labelmap.txt`.
  Voc,     ///< The same in `SegmentationClass`; `ImageSets/Segmentation/default.txt`; `JPEGImages`.
  Coco,    ///< `annotations/instances_default.json` in packed runs; `images`.
  Labelme  ///< `04_04.json` beside `04_04.png`.
};
[[nodiscard]] Names<LabelForm> names_of(LabelForm);

/// Labels of views, as they are to be written.
struct LabelSource {
  const ViewStack<std::int32_t>& maps;  ///< 0 = unlabeled.
  std::vector<LabelInfo> infos{};       ///< Labels without are named after their ids.
  LightFieldPtr pictures{};  ///< Views to write beside the labels, in 8 bits; null = none.
  LabelPlaces places{};      ///< Names of the views; none = row and column.
};

/// Writes a folder that `read_label_files` reads back exactly. Indexed pictures of ids above 255
/// are gray ones of 16 bits. Where a form knows labels by name or color, those of one name or color
/// get other ones, black of pictures as well: returns a sentence about them, else nothing. Atomic.
/// Throws IoError, also if the folder holds files, and for ids
/// above 65535 in pictures; Cancelled.
std::string write_label_folder(const std::filesystem::path& folder, LabelForm form,
                               const LabelSource& source, const Progress& progress);

}  // namespace episcope::io
