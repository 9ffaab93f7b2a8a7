// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/sidecar_maps/map_name.h"

#include "engine/core/text.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace episcope::io {
namespace {

bool is_capital(char c) {
  return c >= 'A' && c <= 'Z';
}

/// Words in lower case: runs of letters, parted also where a capital follows a small letter.
std::vector<std::string> name_words(const std::string& name) {
  std::vector<std::string> words;
  bool is_inside = false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (!is_letter(name[i])) {
      is_inside = false;
      continue;
    }
    const bool is_hump =
        i > 0 && is_capital(name[i]) && is_letter(name[i - 1]) && !is_capital(name[i - 1]);
    if (!is_inside || is_hump) words.emplace_back();
    words.back() += lower_case(name[i]);
    is_inside = true;
  }
  return words;
}

template <std::size_t N>
bool has_one_of(const std::vector<std::string>& words, const std::array<std::string_view, N>& set) {
  return std::ranges::any_of(words, [&](const std::string& word) {
    return std::ranges::find(set, std::string_view(word)) != set.end();
  });
}

constexpr std::array<std::string_view, 2> kInvalidWords{"invalid", "invalidmask"};
constexpr std::array<std::string_view, 3> kValidWords{"valid", "validity", "validmask"};
constexpr std::array<std::string_view, 2> kMaskWords{"mask", "masks"};
constexpr std::array<std::string_view, 14> kLabelWords{
    "label",    "labels",    "lbl",      "labelmap",  "seg",      "segs",      "segmentation",
    "semantic", "semantics", "objectid", "objectids", "instance", "instances", "classes"};
constexpr std::array<std::string_view, 9> kDisparityWords{
    "disp",     "disps",        "disparity",     "disparities", "dispmap",
    "dispmaps", "disparitymap", "disparitymaps", "gtdisp"};
constexpr std::array<std::string_view, 5> kDepthWords{"depth", "depths", "depthmap", "depthmaps",
                                                      "gtdepth"};
/// "mask_center.png" is no region of that name.
constexpr std::array<std::string_view, 10> kMapOwners{"center", "centre", "view", "views", "cam",
                                                      "image",  "img",    "lf",   "u",     "v"};
/// Of what a method has computed, which is no truth.
constexpr std::array<std::string_view, 12> kResultWords{
    "local", "estimate",   "estimates",   "estimated", "result", "results",
    "pred",  "prediction", "predictions", "predicted", "output", "outputs"};
constexpr std::array<std::string_view, 6> kTruthWords{"gt",         "truth",       "groundtruth",
                                                      "annotation", "annotations", "maps"};

}  // namespace

const char* kind_text(MapKind kind) {
  constexpr const char* texts[] = {
      "disparity maps",          "depth maps",  "label maps", "masks of valid pixels",
      "masks of invalid pixels", "region masks"};
  return texts[static_cast<int>(kind)];
}

std::optional<MapKind> map_kind(const std::string& name) {
  const std::vector<std::string> words = name_words(name);
  if (has_one_of(words, kResultWords)) return std::nullopt;
  if (!region_name(name).empty()) return MapKind::Region;
  if (has_one_of(words, kInvalidWords)) return MapKind::Invalid;
  if (has_one_of(words, kValidWords)) return MapKind::Valid;
  if (has_one_of(words, kLabelWords)) return MapKind::Labels;  // "segmentation_mask" too
  if (has_one_of(words, kMaskWords)) return MapKind::Valid;
  if (has_one_of(words, kDisparityWords)) return MapKind::Disparity;
  if (has_one_of(words, kDepthWords)) return MapKind::Depth;
  return std::nullopt;
}

std::string region_name(const std::string& name) {
  constexpr std::string_view prefix = "mask_";
  constexpr std::string_view suffix = "_lowres";
  if (!name.starts_with(prefix)) return {};
  std::string region = name.substr(prefix.size());
  if (region.ends_with(suffix)) region.resize(region.size() - suffix.size());
  const std::vector<std::string> words = name_words(region);
  const bool is_of_a_map = words.empty() || has_one_of(words, kMapOwners) ||
                           has_one_of(words, kLabelWords) || has_one_of(words, kValidWords) ||
                           has_one_of(words, kInvalidWords) || has_one_of(words, kDisparityWords) ||
                           has_one_of(words, kDepthWords) || has_one_of(words, kTruthWords);
  return is_of_a_map ? std::string() : region;
}

bool is_map_folder(const std::string& name) {
  return map_kind(name).has_value() || has_one_of(name_words(name), kTruthWords);
}

NumberedName numbered_name(const std::string& name) {
  constexpr std::size_t kDigits = 9;
  NumberedName split;
  for (std::size_t i = 0; i < name.size();) {
    const std::size_t end = end_of_digits(name, i);
    if (end == i) {
      split.text += lower_case(name[i++]);
      continue;
    }
    const std::size_t begin = std::max(i, end < kDigits ? 0 : end - kDigits);
    split.text += '#';
    split.numbers.push_back(std::stol(name.substr(begin, end - begin)));
    i = end;
  }
  return split;
}

}  // namespace episcope::io
