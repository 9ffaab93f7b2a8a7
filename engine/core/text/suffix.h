// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/text/character.h"

#include <algorithm>
#include <filesystem>
#include <string>

namespace episcope {

/// ASCII letters in lower case.
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return lower_case(c); });
  return text;
}

/// The extension of a file name in lower case, with its dot: ".h5".
[[nodiscard]] inline std::string suffix_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace episcope
