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
/// "gtDepth_05", "label", "valid_mask". Empty for names without such a word.
[[nodiscard]] std::optional<MapKind> map_kind(const std::string& name);

/// Of valid or of invalid pixels, or of a region.
[[nodiscard]] constexpr bool is_mask(MapKind kind) {
  return kind == MapKind::Valid || kind == MapKind::Invalid || kind == MapKind::Region;
}

/// Whether a name is one of truth and says no more: "gt", "ground_truth", "truth", "target".
/// Numbers of that name are disparity.
[[nodiscard]] bool is_bare_truth_name(const std::string& name);

/// What the name of a map says of its truth.
enum class MapClaim {
  True,     ///< "gt", "true", "ground_truth".
  None,     ///< Nothing.
  Computed  ///< "estimate", "error", "confidence"; or "raw", "epi" with no word of truth beside it.
};
[[nodiscard]] MapClaim map_claim(const std::string& name);

/// What the name of a group of arrays says of the truth of those in it. Steps and methods ("raw",
/// "net") say nothing there: they may be of the light field as well.
[[nodiscard]] MapClaim group_claim(const std::string& name);

/// Where a name holds another as whole words, from `begin` up to `end`; both 0 if it does not.
struct NamePart {
  std::size_t begin = 0;
  std::size_t end = 0;
};
/// The longest of `parts`, which are in lower case and have # for any number ("out_#_#").
[[nodiscard]] NamePart find_part(const std::string& name, const std::vector<std::string>& parts);

/// What the name of a map says beside that of what it belongs to: "_mask" of "out_03_04_mask" for
/// "out_#_#".
[[nodiscard]] std::string name_beside(const std::string& name,
                                      const std::vector<std::string>& owners);

/// "planes" for mask_planes, mask_planes_lowres, as the 2016 benchmark calls a region of the center
/// view, and planes_mask. Empty for other names, and for masks that are of a map by their names:
/// "mask", "mask_center", "disparity_mask", "valid_mask".
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
