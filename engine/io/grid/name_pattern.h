// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/name_matcher.h"
#include "engine/io/grid/view_names.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace episcope::io {

/// A user's pattern for the names of views: the whole name with its suffix, with {row} and {col},
/// one of them, or {index}, for whole numbers; maybe {y} and {x} for positions of cameras, which
/// may stand alone; `*` for anything and `?` for one character. Upper and lower case of letters are
/// not told apart. Or `re:` and a regular expression (ECMAScript) for the whole name, with named
/// groups: `re:(?<row>\d+)of(?<col>\d+).*`.
class NamePattern {
 public:
  /// Throws InvalidInput, with a sentence that says what is wrong, also if it is longer than 250
  /// bytes.
  explicit NamePattern(const std::string& text);

  /// What the name of a view says; nothing if it does not match, or if a field is no number. In
  /// polynomial time, whatever the pattern.
  [[nodiscard]] std::optional<NamedView> match(const std::filesystem::path& path) const;

 private:
  std::unique_ptr<const NameMatcher> matcher_;
  std::vector<NameField> fields_;
};

}  // namespace episcope::io
