// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// What a map beside views may hold.
enum class MapKind { Disparity, Depth, Labels, Valid, Invalid, Region };
/// A plural: "disparity maps", "depth maps", "label maps", "masks of valid pixels", …
[[nodiscard]] const char* kind_text(MapKind kind);

/// What the words of a name say that the file, or the files of the folder, hold: "1_1_Disparity",
/// "gtDepth_05", "label", "valid_mask"; empty for names without such a word, and for those of
/// results ("disparity_local").
[[nodiscard]] std::optional<MapKind> map_kind(const std::string& name);

/// "planes" for mask_planes and mask_planes_lowres, as the 2016 benchmark calls a region of the
/// centre view; empty for other names.
[[nodiscard]] std::string region_name(const std::string& name);

/// Whether a folder of this name may hold maps of any kind: "gt", "ground_truth", "depth".
[[nodiscard]] bool is_map_folder(const std::string& name);

/// A name with # for each of its numbers, in lower case, and these numbers: "lf_#_#", {3, 12}. Of
/// runs of more than nine digits the last nine count.
struct NumberedName {
  std::string text;
  std::vector<long> numbers;
};
[[nodiscard]] NumberedName numbered_name(const std::string& name);

}  // namespace episcope::io
