// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/core/text/character.h"
#include "engine/io/grid/name_matcher.h"

#include <algorithm>

namespace episcope::io {
namespace {

/// A part of a pattern: a field, `*`, `?`, or one byte.
struct Part {
  enum class Kind { Byte, Anything, Character, Number, Position };
  Kind kind = Kind::Byte;
  char byte = 0;
};

/// Every place at which the number that begins at `begin` may end, the farthest first.
std::vector<std::size_t> ends_of_number(std::string_view name, std::size_t begin,
                                        bool may_have_fraction) {
  std::size_t first = begin;
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

class Wildcards final : public NameMatcher {
 public:
  explicit Wildcards(const std::string& pattern) {
    for (std::size_t at = 0; at < pattern.size();) {
      if (pattern[at] == '{') {
        at = add_field(pattern, at);
      } else if (pattern[at] == '*') {
        parts_.push_back({Part::Kind::Anything});
        ++at;
      } else if (pattern[at] == '?') {
        parts_.push_back({Part::Kind::Character});
        ++at;
      } else {
        parts_.push_back({Part::Kind::Byte, lower_case(pattern[at++])});
      }
    }
  }

  std::vector<NameField> fields() const override { return fields_; }

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
    parts_.push_back({is_position ? Part::Kind::Position : Part::Kind::Number});
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
      case Part::Kind::Byte:
        return at < name.size() && lower_case(name[at]) == parts_[part].byte &&
               matches(search, part + 1, at + 1);
      case Part::Kind::Character: {
        if (at == name.size()) return false;
        std::size_t end = at + 1;
        while (end < name.size() && continues_character(name[end])) ++end;
        return matches(search, part + 1, end);
      }
      case Part::Kind::Anything:
        return matches(search, part + 1, at) || (at < name.size() && matches(search, part, at + 1));
      case Part::Kind::Number:
      case Part::Kind::Position:
        break;
    }
    const bool may_have_fraction = parts_[part].kind == Part::Kind::Position;
    std::vector<std::size_t> ends = ends_of_number(name, at, may_have_fraction);
    if (part + 1 < parts_.size() && parts_[part + 1].kind == Part::Kind::Number) {
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

  std::vector<Part> parts_;
  std::vector<NameField> fields_;
};

}  // namespace

std::unique_ptr<const NameMatcher> compile_wildcards(const std::string& pattern) {
  return std::make_unique<Wildcards>(pattern);
}

}  // namespace episcope::io
