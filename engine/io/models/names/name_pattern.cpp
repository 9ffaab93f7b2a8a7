// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/name_pattern.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

namespace episcope::io {

/// What a part of a name stands for.
enum class NameField { Row, Column, Index, Y, X };

namespace {

constexpr std::array kNames{"row", "col", "index", "y", "x"};

const char* field_name(NameField field) {
  return kNames[static_cast<std::size_t>(field)];
}

std::optional<NameField> field_named(std::string_view name) {
  const auto found = std::ranges::find(kNames, name);
  if (found == kNames.end()) return std::nullopt;
  return static_cast<NameField>(found - kNames.begin());
}

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
std::optional<T> parsed(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  T value{};
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_all = error == std::errc() && stop == text.data() + text.size();
  return is_all ? std::optional(value) : std::nullopt;
}

/// Whether the text of a field is a number as it must be, which is then stored.
bool store(NameField field, std::string_view text, NamedView& view) {
  const auto is_stored = [&]<class T>(std::optional<T>& value) {
    value = parsed<T>(text);
    return value.has_value();
  };
  const auto is_letter_stored = [&](std::optional<long long>& value) {
    if (text.size() == 1 && is_letter(text[0])) value = lower_case(text[0]) - 'a' + 1;
    return value || is_stored(value);
  };
  switch (field) {
    case NameField::Row:
      return is_letter_stored(view.row);
    case NameField::Column:
      return is_letter_stored(view.column);
    case NameField::Index:
      return is_stored(view.index);
    case NameField::Y:
      return is_stored(view.y);
    case NameField::X:
      return is_stored(view.x);
  }
  return false;
}

/// Fields by the number of their group, from 1 on.
struct Groups {
  std::string expression;  ///< Without names.
  std::vector<std::pair<std::size_t, NameField>> fields;
};

constexpr std::string_view kNumber = "([-+]?[0-9]+|[a-z])";
constexpr std::string_view kCoordinate = "([-+]?[0-9]+(?:\\.[0-9]+)?(?:e[-+]?[0-9]+)?)";
constexpr std::string_view kCharacter = "[^\x80-\xbf][\x80-\xbf]*";  ///< Of UTF-8.

/// Adds the field of a pattern that begins there, and returns where it ends.
std::size_t add_field(const std::string& pattern, std::size_t begin, Groups& groups) {
  const std::size_t end = pattern.find('}', begin);
  const auto field =
      end == std::string::npos
          ? std::nullopt
          : field_named(std::string_view(pattern).substr(begin + 1, end - begin - 1));
  if (!field) {
    throw InvalidInput("the pattern '" + pattern + "' has an unknown field '" +
                       pattern.substr(begin, end == std::string::npos ? end : end - begin + 1) +
                       "'; there are {row}, {col}, {index}, {y} and {x}");
  }
  groups.fields.emplace_back(groups.fields.size() + 1, *field);
  groups.expression += *field == NameField::Y || *field == NameField::X ? kCoordinate : kNumber;
  return end + 1;
}

/// A pattern with {fields}, `*` and `?` as a regular expression.
Groups translated(const std::string& pattern) {
  Groups groups;
  for (std::size_t at = 0; at < pattern.size();) {
    if (pattern[at] == '{') {
      at = add_field(pattern, at, groups);
      continue;
    }
    const char c = pattern[at++];
    if (c == '*') {
      groups.expression += ".*?";
    } else if (c == '?') {
      groups.expression += kCharacter;
    } else {
      if (std::ispunct(static_cast<unsigned char>(c)) != 0) groups.expression += '\\';
      groups.expression += c;
    }
  }
  return groups;
}

/// Numbers that run together have half of the digits each, if that fits; else any.
std::vector<std::string> expressions_of(const std::string& expression) {
  constexpr int kMostHalf = 9;
  const std::string both = fmt::format("{0}{0}", kNumber);
  const std::size_t at = expression.find(both);
  std::vector<std::string> all;
  for (int digits = 1; digits <= kMostHalf && at != std::string::npos; ++digits) {
    const std::string halves =
        fmt::format("([0-9]{{{0}}})([0-9]{{{0},{1}}})(?![0-9])", digits, digits + 1);
    all.push_back(std::string(expression).replace(at, both.size(), halves));
  }
  all.push_back(expression);
  return all;
}

constexpr const char* kRefersBack = "refers back to a group, which is not possible here";
constexpr const char* kTooLarge = "is too large; shorten it";

[[noreturn]] void refuse_regex(const std::string& expression, const std::string& why) {
  throw InvalidInput("the regular expression '" + expression + "' for names of images " + why);
}

/// Takes the names out of named groups, which std::regex does not know.
class GroupNames {
 public:
  explicit GroupNames(const std::string& text) : text_(text) {}

  Groups take_out() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '\\') {
        copy_escape();
      } else if (is_in_class_) {
        is_in_class_ = c != ']';
        copy(1);
      } else if (c == '[') {
        is_in_class_ = true;
        copy(1);
      } else if (c == '(') {
        open_group();
      } else if (c == '{') {
        copy_count();
      } else {
        copy(1);
      }
    }
    return std::move(groups_);
  }

 private:
  void copy(std::size_t count) {
    groups_.expression += text_.substr(at_, count);
    at_ += count;
  }

  // The library's numbers of groups and counts overflow unseen.
  void copy_escape() {
    const char next = at_ + 1 < text_.size() ? text_[at_ + 1] : '\0';
    if (next > '0' && next <= '9') refuse_regex(text_, kRefersBack);
    copy(2);
  }
  void copy_count() {
    constexpr std::size_t most_digits = 4;
    const std::size_t begin = at_ + 1;
    const std::size_t end = std::min(text_.find_first_not_of("0123456789,", begin), text_.size());
    std::size_t digits = 0;
    for (std::size_t i = begin; i < end; ++i) {
      digits = text_[i] == ',' ? 0 : digits + 1;
      if (digits > most_digits) refuse_regex(text_, kTooLarge);
    }
    copy(1);
  }

  void open_group() {
    const std::string_view rest = std::string_view(text_).substr(at_);
    const bool is_python = rest.starts_with("(?P<");
    const bool is_named = is_python || (rest.starts_with("(?<") && !rest.starts_with("(?<=") &&
                                        !rest.starts_with("(?<!"));
    if (!is_named) {
      if (!rest.starts_with("(?")) ++count_;
      copy(1);
      return;
    }
    const std::size_t begin = is_python ? 4 : 3;
    const std::size_t end = rest.find('>');
    const std::string_view name = end == rest.npos ? rest : rest.substr(begin, end - begin);
    const auto field = field_named(name);
    if (!field) {
      refuse_regex(text_, "has an unknown group '" + std::string(name) +
                              "'; there are row, col, index, y and x");
    }
    groups_.fields.emplace_back(++count_, *field);
    groups_.expression += '(';
    at_ += end + 1;
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::size_t count_ = 0;  ///< Of groups so far.
  bool is_in_class_ = false;
  Groups groups_;
};

std::regex compile_regex(const std::string& expression, const std::string& as_given,
                         std::regex::flag_type flags = {}) {
  try {
    // With libstdc++'s own flag, matching cannot take exponential time.
    return std::regex(expression,
                      std::regex::ECMAScript | std::regex_constants::__polynomial | flags);
  } catch (const std::regex_error& error) {
    switch (error.code()) {
      case std::regex_constants::error_brack:
        refuse_regex(as_given, "lacks a ] or a [");
      case std::regex_constants::error_paren:
        refuse_regex(
            as_given,
            "lacks a ) or a (, repeats nothing with *, + or ?, or has a kind of group that is "
            "not known");
      case std::regex_constants::error_brace:
      case std::regex_constants::error_badbrace:
        refuse_regex(as_given, "has a wrong {…}; a count such as {1,3} is expected");
      case std::regex_constants::error_badrepeat:
        refuse_regex(as_given, "repeats nothing with *, + or ?");
      case std::regex_constants::error_range:
        refuse_regex(as_given, "has a wrong range in […]");
      case std::regex_constants::error_complexity:
      case std::regex_constants::error_backref:
        refuse_regex(as_given, kRefersBack);
      case std::regex_constants::error_space:
      case std::regex_constants::error_stack:
        refuse_regex(as_given, kTooLarge);
      default:
        refuse_regex(as_given, "is not valid; see a description of ECMAScript's expressions");
    }
  }
}

}  // namespace

struct NamePattern::Compiled {
  std::vector<std::regex> expressions;  ///< Of which the first that matches counts.
  std::vector<std::pair<std::size_t, NameField>> fields;  ///< By the number of their group.
};

NamePattern::NamePattern(const std::string& text) {
  if (text.size() > kLongestPattern) {
    throw InvalidInput(
        "the pattern for names of images is longer than 250 characters; shorten it, with * for "
        "what does not matter");
  }
  Compiled compiled;
  if (text.starts_with(kRegexPrefix)) {
    const std::string given = text.substr(kRegexPrefix.size());
    const Groups groups = GroupNames(given).take_out();
    compiled = {{compile_regex(groups.expression, given)}, groups.fields};
  } else {
    const Groups groups = translated(text);
    compiled.fields = groups.fields;
    for (const std::string& expression : expressions_of(groups.expression)) {
      compiled.expressions.push_back(compile_regex(expression, text, std::regex::icase));
    }
  }
  std::vector<NameField> fields;
  for (const auto& [group, field] : compiled.fields) fields.push_back(field);
  require_fields(text, std::move(fields));
  compiled_ = std::make_shared<const Compiled>(std::move(compiled));
}

std::optional<NamedView> NamePattern::match(const std::filesystem::path& path) const {
  const std::string name = path.filename().string();
  std::smatch found;
  const bool is_match = std::ranges::any_of(
      compiled_->expressions, [&](const std::regex& one) { return regex_match(name, found, one); });
  if (!is_match) return std::nullopt;
  NamedView view{.path = path};
  for (const auto& [group, field] : compiled_->fields) {
    if (!store(field, found[group].str(), view)) return std::nullopt;
  }
  return view;
}

}  // namespace episcope::io
