// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/name_matcher.h"

#include <algorithm>
#include <array>

namespace episcope::io {
namespace {

constexpr std::array kNames{"row", "col", "index", "y", "x"};

}  // namespace

const char* field_name(NameField field) {
  return kNames[static_cast<std::size_t>(field)];
}

std::optional<NameField> field_named(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<NameField>(found - kNames.begin());
}

}  // namespace episcope::io
