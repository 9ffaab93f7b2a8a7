// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/result_source.h"

#include "app/session/scene/load_scene.h"

#include <iterator>

namespace episcope {

namespace fs = std::filesystem;

std::string source_text(const std::string& input, const fs::path& result) {
  if (!builtin_scene_id(input).empty()) return input;
  fs::path source = fs::weakly_canonical(input);
  if (!source.has_filename()) source = source.parent_path();
  const fs::path folder = fs::weakly_canonical(fs::absolute(result)).parent_path();
  const bool share_folder = std::distance(source.begin(), source.end()) > 2 &&
                            std::distance(folder.begin(), folder.end()) > 1 &&
                            *std::next(source.begin()) == *std::next(folder.begin());
  if (!share_folder) return source.string();
  const std::string relative = source.lexically_relative(folder).string();
  const bool reads_as_builtin = !builtin_scene_id(relative).empty();
  return reads_as_builtin ? (fs::path(".") / relative).string() : relative;
}

std::string existing_source(const std::string& source, const fs::path& result) {
  if (source.empty() || !builtin_scene_id(source).empty()) return source;
  // An absolute path stands for itself.
  const fs::path path = result.parent_path() / source;
  std::error_code ignored;
  return fs::exists(path, ignored) ? path.string() : std::string();
}

}  // namespace episcope
