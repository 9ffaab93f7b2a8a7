// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace episcope::io {

/// What the name of an image says of its place.
struct NamedView {
  std::filesystem::path path;
  std::optional<long long> row{};
  std::optional<long long> column{};
  std::optional<long long> index{};  ///< Instead of row and column.
  std::optional<double> y{};         ///< Position of the camera.
  std::optional<double> x{};
};

/// A user's pattern for the names of views: the whole name with its suffix, with {row} and {col},
/// one of them, or {index}, for whole numbers; maybe {y} and {x} for positions of cameras, which
/// may stand alone; `*` for anything and `?` for one character. Upper and lower case of letters are
/// not told apart. Or `re:` and a regular expression (ECMAScript) for the whole name, with named
/// groups: `re:(?<row>\d+)of(?<col>\d+).*`.
class NamePattern {
 public:
  class Matcher;

  /// Throws InvalidInput, with a sentence that says what is wrong, also if it is longer than 250
  /// bytes.
  explicit NamePattern(const std::string& text);

  /// What the name of a view says; nothing if it does not match, or if a field is no number. In
  /// polynomial time, whatever the pattern.
  [[nodiscard]] std::optional<NamedView> match(const std::filesystem::path& path) const;

 private:
  std::shared_ptr<const Matcher> matcher_;
};

}  // namespace episcope::io
