// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/moved_inputs.h"

#include "app/session/scene/load_scene.h"

#include <algorithm>

namespace episcope {

namespace fs = std::filesystem;

MovedFolder moved_folder(const fs::path& from, const fs::path& to) {
  fs::path before = from;
  fs::path after = to;
  while (before.has_relative_path() && after.has_relative_path() &&
         before.filename() == after.filename()) {
    before = before.parent_path();
    after = after.parent_path();
  }
  return {before, after};
}

std::string moved_input(const std::string& input, const MovedFolder& moved) {
  std::error_code ignored;
  if (!builtin_scene_id(input).empty() || fs::exists(input, ignored)) return {};
  const fs::path path = input;
  const auto [end, rest] =
      std::mismatch(moved.from.begin(), moved.from.end(), path.begin(), path.end());
  if (end != moved.from.end()) return {};
  fs::path found = moved.to;
  for (auto part = rest; part != path.end(); ++part) found /= *part;
  return fs::exists(found, ignored) ? found.string() : std::string();
}

}  // namespace episcope
