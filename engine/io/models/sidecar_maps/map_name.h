// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// Content of a map beside views.
enum class MapKind { Disparity, Depth, Labels, Valid, Invalid, Region };
/// A plural: "disparity maps", "depth maps", "label maps", "masks of valid pixels", …
[[nodiscard]] const char* kind_text(MapKind kind);

/// Content according to the words in the name of a file or of its folder: "1_1_Disparity",
/// "gtDepth_05", "label", "valid_mask". Empty for names without such a word and for names of
/// results ("disparity_local").
[[nodiscard]] std::optional<MapKind> map_kind(const std::string& name);

/// "planes" for mask_planes and mask_planes_lowres, as the 2016 benchmark calls a region of the
/// center view. Empty for other names.
[[nodiscard]] std::string region_name(const std::string& name);

/// Whether a folder of this name may hold maps of any kind: "gt", "ground_truth", "depth".
[[nodiscard]] bool is_map_folder(const std::string& name);

/// Name with # for each of its numbers, in lower case, and these numbers: "lf_#_#", {3, 12}. Only
/// the last nine digits of longer runs count.
struct NumberedName {
  std::string text;
  std::vector<long> numbers;
};
[[nodiscard]] NumberedName numbered_name(const std::string& name);

}  // namespace episcope::io
