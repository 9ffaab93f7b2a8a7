// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/scene.h"

#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

/// Reads a table of the colors that stand for labels: a line `r,g,b,id,name` each, separated by
/// commas, semicolons, tabs or spaces; the name may be missing. Id 0 is the background. Skips a
/// heading, empty lines and those that begin with `#`. Reads `labelmap.txt` of CVAT as well, lines
/// `name:r,g,b:parts:actions`, whose ids count from 0 for `background`, else from 1. Throws
/// IoError, naming the line, for other lines and for a color that stands there twice.
[[nodiscard]] std::vector<LabelInfo> read_color_table(const std::filesystem::path& path);

/// Writes `labelmap.txt` as CVAT and Datumaro have it, with a background in black; a label
/// called background becomes background_ID. Precondition: colors are distinct, and none is black.
/// Atomic. Throws IoError.
void write_label_map_text(const std::filesystem::path& path, const std::vector<LabelInfo>& labels);

inline constexpr const char* kLabelMap = "labelmap.txt";
/// `labelmap.txt` in a folder or, as VOC folders have it, in the one around; empty if there is
/// none.
[[nodiscard]] std::filesystem::path label_map_beside(const std::filesystem::path& folder);

/// Colors that programs share, with their ids.
struct SharedColors {
  std::string name;               ///< "voc", as users name it,
  std::string title;              ///< and as it is called in sentences.
  std::vector<LabelInfo> labels;  ///< Id 0 = unlabeled.
};
/// "voc": the 256 colors of PASCAL VOC's devkit, id = place, without names; 255 is void and has id
/// 0. "cityscapes": ids, names and colors of cityscapesscripts/helpers/labels.py.
[[nodiscard]] const std::vector<SharedColors>& shared_colors();

/// "#00ff80".
[[nodiscard]] std::string color_text(const Rgb& color);

}  // namespace episcope::io
