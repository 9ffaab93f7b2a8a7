// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/name_pattern.h"

#include "engine/core/error.h"

#include <algorithm>
#include <charconv>

namespace episcope::io {
namespace {

constexpr std::size_t kLongestPattern = 250;
constexpr std::string_view kRegexPrefix = "re:";

void require_fields(const std::string& text, std::vector<NameField> fields) {
  const auto has = [&](NameField field) {
    return std::ranges::find(fields, field) != fields.end();
  };
  const bool has_place = has(NameField::Row) || has(NameField::Column) ||
                         (has(NameField::Y) && has(NameField::X) && !has(NameField::Index));
  if (has_place == has(NameField::Index)) {
    throw InvalidInput("the pattern '" + text + "' must contain " +
                       (text.starts_with(kRegexPrefix)
                            ? "the groups (?<row>…) and (?<col>…), or (?<index>…), as in "
                              "re:view_(?<row>[0-9]+)_(?<col>[0-9]+).*"
                            : "{row} and {col}, or {index}, as in view_{row}_{col}.png"));
  }
  std::ranges::sort(fields);
  const auto twice = std::ranges::adjacent_find(fields);
  if (twice != fields.end()) {
    throw InvalidInput("the pattern '" + text + "' has the field " + field_name(*twice) +
                       " twice; leave it in one place");
  }
}

template <class T>
std::optional<T> number_of(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_all = error == std::errc() && stop == text.data() + text.size();
  return is_all ? std::optional(value) : std::nullopt;
}

/// Whether the text of a field is a number as it must be, which is then stored.
bool store(NameField field, std::string_view text, NamedView& view) {
  const auto is_stored = [&]<class T>(std::optional<T>& value) {
    value = number_of<T>(text);
    return value.has_value();
  };
  switch (field) {
    case NameField::Row:
      return is_stored(view.row);
    case NameField::Column:
      return is_stored(view.column);
    case NameField::Index:
      return is_stored(view.index);
    case NameField::Y:
      return is_stored(view.y);
    case NameField::X:
      return is_stored(view.x);
  }
  return false;
}

}  // namespace

NamePattern::NamePattern(const std::string& text) {
  if (text.size() > kLongestPattern) {
    throw InvalidInput(
        "the pattern for names of images is longer than 250 characters; shorten it, with * for "
        "what does not matter");
  }
  const bool is_regex = text.starts_with(kRegexPrefix);
  matcher_ = is_regex ? compile_regex(text.substr(kRegexPrefix.size())) : compile_wildcards(text);
  fields_ = matcher_->fields();
  require_fields(text, fields_);
}

std::optional<NamedView> NamePattern::match(const std::filesystem::path& path) const {
  const auto texts = matcher_->match(path.filename().string());
  if (!texts) return std::nullopt;
  NamedView view{.path = path};
  for (std::size_t i = 0; i < fields_.size(); ++i) {
    if (!store(fields_[i], (*texts)[i], view)) return std::nullopt;
  }
  return view;
}

}  // namespace episcope::io
