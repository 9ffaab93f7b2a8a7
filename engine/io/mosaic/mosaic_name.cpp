// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/mosaic/mosaic_name.h"

#include "engine/core/text/suffix.h"
#include "engine/io/grid/decode_image.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace episcope::io {
namespace {

constexpr std::string_view kEslf = "eslf";
constexpr std::array<std::string_view, 3> kLensletWords{"macpi", "lenslet", "lenslets"};

/// "eslf" and "flower_eslf", but not "heslf".
bool ends_with_word(const std::string& stem, std::string_view word) {
  if (!stem.ends_with(word)) return false;
  if (stem.size() == word.size()) return true;
  const char before = stem[stem.size() - word.size() - 1];
  return before == '_' || before == '-' || before == '.' || before == ' ';
}

}  // namespace

MosaicName mosaic_name(const std::filesystem::path& path) {
  if (!is_image_name(path)) return MosaicName::Plain;
  const std::string stem = lower_case(path.stem().string());
  if (ends_with_word(stem, kEslf)) return MosaicName::Eslf;
  for (const std::string_view word : kLensletWords) {
    if (ends_with_word(stem, word)) return MosaicName::Lenslets;
  }
  return stem == "lf" ? MosaicName::Mosaic : MosaicName::Plain;
}

std::string scene_of_mosaic(const std::filesystem::path& path) {
  std::string stem = lower_case(path.stem().string());
  for (const std::string_view word :
       {kEslf, kLensletWords[0], kLensletWords[1], kLensletWords[2]}) {
    if (stem.size() <= word.size() + 1 || !ends_with_word(stem, word)) continue;
    stem.resize(stem.size() - word.size() - 1);
    break;
  }
  return stem;
}

}  // namespace episcope::io
