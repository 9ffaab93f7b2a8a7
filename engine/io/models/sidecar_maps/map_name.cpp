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
/// Of what a method has computed, or of what is told about a map, which is no truth.
constexpr std::array<std::string_view, 31> kResultWords{
    "local", "est",         "estimate",   "estimates",   "estimated",   "result",   "results",
    "pred",  "preds",       "prediction", "predictions", "predicted",   "output",   "outputs",
    "error", "errors",      "err",        "std",         "stddev",      "var",      "variance",
    "sigma", "uncertainty", "conf",       "confidence",  "confidences", "residual", "residuals",
    "cost",  "costs",       "epinet"};
/// Of a step or a method on the way to a map: of truth as well, where its name says so.
constexpr std::array<std::string_view, 11> kStepWords{"init",     "initial", "raw",    "filtered",
                                                      "smoothed", "refined", "epi",    "crf",
                                                      "sgm",      "net",     "network"};
constexpr std::array<std::string_view, 6> kTruthWords{"gt",         "truth",       "groundtruth",
                                                      "annotation", "annotations", "maps"};
constexpr std::array<std::string_view, 8> kTrueWords{
    "gt", "true", "truth", "groundtruth", "gtdisp", "gtdepth", "annotation", "annotations"};
constexpr std::array<std::string_view, 5> kBareNames{"gt", "ground_truth", "groundtruth", "truth",
                                                     "target"};

/// What a name says beside the word "mask" at its begin, at its end or before numbers and owners:
/// "object" of "object_mask_03_03"; empty if it says nothing, or has no such word.
std::string beside_mask(const std::string& name) {
  constexpr std::string_view kMask = "mask";
  const auto ends_word = [&](std::size_t i) { return i >= name.size() || !is_letter(name[i]); };
  const auto begins_word = [&](std::size_t i) {
    return i == 0 || !is_letter(name[i - 1]) || (is_capital(name[i]) && !is_capital(name[i - 1]));
  };
  const auto trimmed = [](const std::string& text) {
    const auto is_mark = [](char c) { return !is_letter(c) && !is_digit(c); };
    const auto begin = std::ranges::find_if_not(text, is_mark);
    const auto end = std::find_if_not(text.rbegin(), text.rend(), is_mark).base();
    return begin < end ? std::string(begin, end) : std::string();
  };
  const std::string small = lower_case(name);
  for (std::size_t at = small.find(kMask); at != std::string::npos;
       at = small.find(kMask, at + 1)) {
    const std::size_t end = at + kMask.size() + (small.substr(at).starts_with("masks") ? 1 : 0);
    if (!begins_word(at) || !ends_word(end)) continue;
    const std::string before = trimmed(name.substr(0, at));
    return before.empty() ? trimmed(name.substr(end)) : before;
  }
  return {};
}

/// Where a part of a name ends that begins there; npos if another text does.
std::size_t end_of_part(const std::string& part, const std::string& name, std::size_t at) {
  for (const char c : part) {
    const std::size_t end = end_of_digits(name, at);
    const bool is_number = c == '#' && end > at;
    if (!is_number && (at >= name.size() || lower_case(name[at]) != c)) return std::string::npos;
    at = is_number ? end : at + 1;
  }
  return at;
}

}  // namespace

const char* kind_text(MapKind kind) {
  constexpr const char* texts[] = {
      "disparity maps",          "depth maps",  "label maps", "masks of valid pixels",
      "masks of invalid pixels", "region masks"};
  return texts[static_cast<int>(kind)];
}

std::optional<MapKind> map_kind(const std::string& name) {
  const std::vector<std::string> words = name_words(name);
  if (!region_name(name).empty()) return MapKind::Region;
  if (has_one_of(words, kInvalidWords)) return MapKind::Invalid;
  if (has_one_of(words, kValidWords)) return MapKind::Valid;
  if (has_one_of(words, kLabelWords)) return MapKind::Labels;  // "segmentation_mask" too
  if (has_one_of(words, kMaskWords)) return MapKind::Valid;
  if (has_one_of(words, kDisparityWords)) return MapKind::Disparity;
  if (has_one_of(words, kDepthWords)) return MapKind::Depth;
  return std::nullopt;
}

bool is_bare_truth_name(const std::string& name) {
  return std::ranges::find(kBareNames, lower_case(name)) != kBareNames.end();
}

MapClaim map_claim(const std::string& name) {
  const std::vector<std::string> words = name_words(name);
  if (has_one_of(words, kResultWords)) return MapClaim::Computed;
  if (has_one_of(words, kTrueWords)) return MapClaim::True;
  return has_one_of(words, kStepWords) ? MapClaim::Computed : MapClaim::None;
}

MapClaim group_claim(const std::string& name) {
  const std::vector<std::string> words = name_words(name);
  if (has_one_of(words, kResultWords)) return MapClaim::Computed;
  return has_one_of(words, kTrueWords) ? MapClaim::True : MapClaim::None;
}

NamePart find_part(const std::string& name, const std::vector<std::string>& parts) {
  const auto is_inside = [&](std::size_t i) {
    return i < name.size() && (is_letter(name[i]) || is_digit(name[i]));
  };
  NamePart longest;
  for (const std::string& part : parts) {
    for (std::size_t begin = 0; begin < name.size(); ++begin) {
      if (begin > 0 && is_inside(begin - 1)) continue;
      const std::size_t end = end_of_part(part, name, begin);
      if (end == std::string::npos || is_inside(end)) continue;
      if (end - begin > longest.end - longest.begin) longest = {begin, end};
    }
  }
  return longest;
}

std::string name_beside(const std::string& name, const std::vector<std::string>& owners) {
  const NamePart owner = find_part(name, owners);
  return name.substr(0, owner.begin) + name.substr(owner.end);
}

std::string region_name(const std::string& name) {
  constexpr std::string_view suffix = "_lowres";
  std::string region = beside_mask(name);
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
