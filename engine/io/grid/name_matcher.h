// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace episcope::io {

/// What a part of a name stands for.
enum class NameField { Row, Column, Index, Y, X };

/// "row", "col", "index", "y", "x".
[[nodiscard]] const char* field_name(NameField field);
[[nodiscard]] std::optional<NameField> field_named(std::string_view name);

/// Finds fields in names.
class NameMatcher {
 public:
  virtual ~NameMatcher() = default;
  /// Fields in the order of the pattern.
  [[nodiscard]] virtual std::vector<NameField> fields() const = 0;
  /// The texts of the fields; nothing if the name as a whole does not match.
  [[nodiscard]] virtual std::optional<std::vector<std::string>> match(
      const std::string& name) const = 0;
};

/// Of a pattern with {fields}, `*` and `?`. Throws InvalidInput for an unknown field.
[[nodiscard]] std::unique_ptr<const NameMatcher> compile_wildcards(const std::string& pattern);

/// Of a regular expression with named groups. Throws InvalidInput if it is none, or if it needs
/// what takes more than polynomial time (references back).
[[nodiscard]] std::unique_ptr<const NameMatcher> compile_regex(const std::string& expression);

}  // namespace episcope::io
