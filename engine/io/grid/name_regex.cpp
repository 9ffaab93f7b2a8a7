// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/error.h"
#include "engine/io/grid/name_matcher.h"

#include <algorithm>
#include <regex>

namespace episcope::io {
namespace {

constexpr const char* kRefersBack = "refers back to a group, which is not possible here";
constexpr const char* kTooLarge = "is too large; shorten it";

/// Fields by the number of their group, from 1 on.
struct Groups {
  std::string expression;  ///< Without names.
  std::vector<std::pair<std::size_t, NameField>> fields;
};

[[noreturn]] void refuse(const std::string& expression, const std::string& why) {
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
    if (next > '0' && next <= '9') refuse(text_, kRefersBack);
    copy(2);
  }
  void copy_count() {
    constexpr std::size_t most_digits = 4;
    const std::size_t begin = at_ + 1;
    const std::size_t end = std::min(text_.find_first_not_of("0123456789,", begin), text_.size());
    std::size_t digits = 0;
    for (std::size_t i = begin; i < end; ++i) {
      digits = text_[i] == ',' ? 0 : digits + 1;
      if (digits > most_digits) refuse(text_, kTooLarge);
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
      refuse(text_, "has an unknown group '" + std::string(name) +
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

std::regex compile(const std::string& expression, const std::string& as_given) {
  try {
    // With libstdc++'s own flag, matching cannot take exponential time.
    return std::regex(expression, std::regex::ECMAScript | std::regex_constants::__polynomial);
  } catch (const std::regex_error& error) {
    switch (error.code()) {
      case std::regex_constants::error_brack:
        refuse(as_given, "lacks a ] or a [");
      case std::regex_constants::error_paren:
        refuse(as_given,
               "lacks a ) or a (, repeats nothing with *, + or ?, or has a kind of group that is "
               "not known");
      case std::regex_constants::error_brace:
      case std::regex_constants::error_badbrace:
        refuse(as_given, "has a wrong {…}; a count such as {1,3} is expected");
      case std::regex_constants::error_badrepeat:
        refuse(as_given, "repeats nothing with *, + or ?");
      case std::regex_constants::error_range:
        refuse(as_given, "has a wrong range in […]");
      case std::regex_constants::error_complexity:
      case std::regex_constants::error_backref:
        refuse(as_given, kRefersBack);
      case std::regex_constants::error_space:
      case std::regex_constants::error_stack:
        refuse(as_given, kTooLarge);
      default:
        refuse(as_given, "is not valid; see a description of ECMAScript's expressions");
    }
  }
}

class Regex final : public NameMatcher {
 public:
  explicit Regex(const std::string& text)
      : groups_(GroupNames(text).take_out()), expression_(compile(groups_.expression, text)) {}

  std::vector<NameField> fields() const override {
    std::vector<NameField> fields;
    for (const auto& [group, field] : groups_.fields) fields.push_back(field);
    return fields;
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

std::unique_ptr<const NameMatcher> compile_regex(const std::string& expression) {
  return std::make_unique<Regex>(expression);
}

}  // namespace episcope::io
