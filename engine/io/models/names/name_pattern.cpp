// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/name_pattern.h"

#include "engine/core/error.h"
#include "engine/core/text.h"

#include <algorithm>
#include <array>
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

}  // namespace

/// Finds fields in names.
class NamePattern::Matcher {
 public:
  virtual ~Matcher() = default;
  /// The texts of the fields; nothing if the name as a whole does not match.
  [[nodiscard]] virtual std::optional<std::vector<std::string>> match(
      const std::string& name) const = 0;
  /// In the order of the pattern.
  [[nodiscard]] const std::vector<NameField>& fields() const { return fields_; }

 protected:
  std::vector<NameField> fields_;
};

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

/// A part of a pattern: a field, `*`, `?`, or one byte.
struct PatternPart {
  enum class Kind { Byte, Anything, Character, Number, Coordinate };
  Kind kind = Kind::Byte;
  char byte = 0;
};

/// Every place at which the number, or letter, that begins at `begin` may end, the farthest first.
std::vector<std::size_t> ends_of_number(std::string_view name, std::size_t begin,
                                        bool may_have_fraction) {
  std::size_t first = begin;
  if (!may_have_fraction && first < name.size() && is_letter(name[first])) return {first + 1};
  if (first < name.size() && (name[first] == '-' || name[first] == '+')) ++first;
  std::size_t end = end_of_digits(name, first);
  if (end == first) return {};
  if (may_have_fraction) {
    if (end + 1 < name.size() && name[end] == '.' && is_digit(name[end + 1])) {
      end = end_of_digits(name, end + 1);
    }
    std::size_t exponent = end;
    if (exponent < name.size() && lower_case(name[exponent]) == 'e') {
      ++exponent;
      if (exponent < name.size() && (name[exponent] == '-' || name[exponent] == '+')) ++exponent;
      const std::size_t stop = end_of_digits(name, exponent);
      if (stop > exponent) end = stop;
    }
  }
  std::vector<std::size_t> ends;
  for (; end > first; --end) {
    if (is_digit(name[end - 1])) ends.push_back(end);
  }
  return ends;
}

/// Of a pattern with {fields}, `*` and `?`.
class Wildcards final : public NamePattern::Matcher {
 public:
  explicit Wildcards(const std::string& pattern) {
    for (std::size_t at = 0; at < pattern.size();) {
      if (pattern[at] == '{') {
        at = add_field(pattern, at);
      } else if (pattern[at] == '*') {
        parts_.push_back({PatternPart::Kind::Anything});
        ++at;
      } else if (pattern[at] == '?') {
        parts_.push_back({PatternPart::Kind::Character});
        ++at;
      } else {
        parts_.push_back({PatternPart::Kind::Byte, lower_case(pattern[at++])});
      }
    }
  }

  std::optional<std::vector<std::string>> match(const std::string& name) const override {
    Search search{name, std::vector<bool>((parts_.size() + 1) * (name.size() + 1)), {}};
    if (!matches(search, 0, 0)) return std::nullopt;
    return std::vector<std::string>(search.texts.rbegin(), search.texts.rend());
  }

 private:
  struct Search {
    std::string_view name;
    /// What need not be tried again: a part of the pattern at a place of the name.
    std::vector<bool> has_failed;
    std::vector<std::string> texts;  ///< Of the fields, the last first.
  };

  std::size_t add_field(const std::string& pattern, std::size_t begin) {
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
    const bool is_position = *field == NameField::Y || *field == NameField::X;
    parts_.push_back({is_position ? PatternPart::Kind::Coordinate : PatternPart::Kind::Number});
    fields_.push_back(*field);
    return end + 1;
  }

  bool matches(Search& search, std::size_t part, std::size_t at) const {
    if (part == parts_.size()) return at == search.name.size();
    const std::size_t state = part * (search.name.size() + 1) + at;
    if (search.has_failed[state]) return false;
    const bool is_match = continues(search, part, at);
    if (!is_match) search.has_failed[state] = true;
    return is_match;
  }

  /// `matches` for the part at hand, and then for the rest.
  bool continues(Search& search, std::size_t part, std::size_t at) const {
    const std::string_view name = search.name;
    switch (parts_[part].kind) {
      case PatternPart::Kind::Byte:
        return at < name.size() && lower_case(name[at]) == parts_[part].byte &&
               matches(search, part + 1, at + 1);
      case PatternPart::Kind::Character: {
        if (at == name.size()) return false;
        std::size_t end = at + 1;
        while (end < name.size() && continues_character(name[end])) ++end;
        return matches(search, part + 1, end);
      }
      case PatternPart::Kind::Anything:
        return matches(search, part + 1, at) || (at < name.size() && matches(search, part, at + 1));
      case PatternPart::Kind::Number:
      case PatternPart::Kind::Coordinate:
        break;
    }
    const bool may_have_fraction = parts_[part].kind == PatternPart::Kind::Coordinate;
    std::vector<std::size_t> ends = ends_of_number(name, at, may_have_fraction);
    if (part + 1 < parts_.size() && parts_[part + 1].kind == PatternPart::Kind::Number) {
      // Digits that run together belong to both by halves, if that fits.
      const std::size_t half = at + (end_of_digits(name, at) - at) / 2;
      std::stable_partition(ends.begin(), ends.end(), [&](std::size_t end) { return end == half; });
    }
    for (const std::size_t end : ends) {
      if (!matches(search, part + 1, end)) continue;
      search.texts.emplace_back(name.substr(at, end - at));
      return true;
    }
    return false;
  }

  std::vector<PatternPart> parts_;
};

constexpr const char* kRefersBack = "refers back to a group, which is not possible here";
constexpr const char* kTooLarge = "is too large; shorten it";

/// Fields by the number of their group, from 1 on.
struct Groups {
  std::string expression;  ///< Without names.
  std::vector<std::pair<std::size_t, NameField>> fields;
};

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

std::regex compile_regex(const std::string& expression, const std::string& as_given) {
  try {
    // With libstdc++'s own flag, matching cannot take exponential time.
    return std::regex(expression, std::regex::ECMAScript | std::regex_constants::__polynomial);
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

/// Of a regular expression with named groups.
class Regex final : public NamePattern::Matcher {
 public:
  explicit Regex(const std::string& text)
      : groups_(GroupNames(text).take_out()), expression_(compile_regex(groups_.expression, text)) {
    for (const auto& [group, field] : groups_.fields) fields_.push_back(field);
  }

  std::optional<std::vector<std::string>> match(const std::string& name) const override {
    std::smatch found;
    if (!std::regex_match(name, found, expression_)) return std::nullopt;
    std::vector<std::string> texts;
    for (const auto& [group, field] : groups_.fields) texts.push_back(found[group]);
    return texts;
  }

 private:
  Groups groups_;
  std::regex expression_;
};

}  // namespace

NamePattern::NamePattern(const std::string& text) {
  if (text.size() > kLongestPattern) {
    throw InvalidInput(
        "the pattern for names of images is longer than 250 characters; shorten it, with * for "
        "what does not matter");
  }
  const bool is_regex = text.starts_with(kRegexPrefix);
  if (is_regex) {
    matcher_ = std::make_shared<const Regex>(text.substr(kRegexPrefix.size()));
  } else {
    matcher_ = std::make_shared<const Wildcards>(text);
  }
  require_fields(text, matcher_->fields());
}

std::optional<NamedView> NamePattern::match(const std::filesystem::path& path) const {
  const auto texts = matcher_->match(path.filename().string());
  if (!texts) return std::nullopt;
  NamedView view{.path = path};
  const std::vector<NameField>& fields = matcher_->fields();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!store(fields[i], (*texts)[i], view)) return std::nullopt;
  }
  return view;
}

}  // namespace episcope::io
