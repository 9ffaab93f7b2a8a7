// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random_kind.h"

#include <algorithm>

namespace episcope::scenes {

const std::vector<std::string>& random_kind_names() {
  static const std::vector<std::string> names = {
      "any",    "occlusion", "dark", "thin",   "plain",   "periodic", "shiny",
      "uneven", "noisy",     "room", "smooth", "aliased", "faint"};
  return names;
}

const std::string& random_kind_name(RandomKind kind) {
  return random_kind_names()[static_cast<std::size_t>(kind)];
}

std::optional<RandomKind> random_kind_of(const std::string& name) {
  const std::vector<std::string>& names = random_kind_names();
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<RandomKind>(found - names.begin());
}

}  // namespace episcope::scenes
