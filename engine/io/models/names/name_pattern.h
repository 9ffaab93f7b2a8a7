// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace episcope::io {

/// Place of an image according to its name.
struct NamedView {
  std::filesystem::path path;
  std::optional<long long> row{};
  std::optional<long long> column{};
  std::optional<long long> index{};  ///< Instead of row and column.
  std::optional<double> y{};         ///< Position of the camera.
  std::optional<double> x{};
};

/// Pattern for the names of views, as users write it. It matches the whole name with its suffix and
/// ignores case. Fields: {row} and {col}, one of them, or {index}, for whole numbers, the first two
/// also for one letter (a = 1); {y} and {x} for positions of cameras, also alone; `*` for anything
/// and `?` for one character. Or `re:` and a regular expression (ECMAScript) with named groups:
/// `re:(?<row>\d+)of(?<col>\d+).*`.
class NamePattern {
 public:
  /// Throws InvalidInput with a sentence about the mistake, also for more than 250 bytes.
  explicit NamePattern(const std::string& text);

  /// Reads the fields of a name; nothing if it does not match, or if a field is no number. Takes
  /// polynomial time for any pattern.
  [[nodiscard]] std::optional<NamedView> match(const std::filesystem::path& path) const;

 private:
  struct Compiled;
  std::shared_ptr<const Compiled> compiled_;
};

}  // namespace episcope::io
