// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/random/kinds.h"

namespace episcope::scenes {

const std::vector<std::string>& random_kind_names() {
  static const std::vector<std::string> names = {"any",   "occlusion", "dark",  "thin",
                                                 "plain", "periodic",  "shiny", "uneven",
                                                 "noisy", "room",      "smooth"};
  return names;
}

const std::string& random_kind_name(RandomKind kind) {
  return random_kind_names()[static_cast<std::size_t>(kind)];
}

}  // namespace episcope::scenes
