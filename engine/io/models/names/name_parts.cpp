// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/models/names/name_parts.h"

#include "engine/core/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <unordered_map>

namespace episcope::io {
namespace {

constexpr std::size_t kLongestCount = 18;  ///< Digits that a long long holds.

/// The end of the number that begins with the digit at `begin`: digits, maybe with a fraction,
/// maybe with an exponent that has a sign ("5.9e-08", but not "12e4", which is no number in a
/// name).
std::size_t end_of_number(std::string_view text, std::size_t begin) {
  std::size_t end = end_of_digits(text, begin);
  if (end + 1 < text.size() && text[end] == '.' && is_digit(text[end + 1])) {
    end = end_of_digits(text, end + 1);
  }
  const bool has_exponent = end + 2 < text.size() && (text[end] == 'e' || text[end] == 'E') &&
                            (text[end + 1] == '-' || text[end + 1] == '+') &&
                            is_digit(text[end + 2]);
  return has_exponent ? end_of_digits(text, end + 2) : end;
}

NameNumber number_of(std::string_view text) {
  NameNumber number{.text = std::string(text)};
  number.is_whole = end_of_digits(text, 0) == text.size();
  std::from_chars(text.data(), text.data() + text.size(), number.value);
  return number;
}

}  // namespace

std::optional<long long> NameNumber::count() const {
  if (!is_whole || text.size() > kLongestCount) return std::nullopt;
  long long count = 0;
  std::from_chars(text.data(), text.data() + text.size(), count);
  return count;
}

std::optional<long long> NameNumber::signed_count() const {
  const auto unsigned_count = count();
  return unsigned_count && has_minus ? -*unsigned_count : unsigned_count;
}

NameParts split_name(const std::filesystem::path& path) {
  const std::string stem = path.stem().string();
  NameParts parts;
  for (std::size_t at = 0; at < stem.size();) {
    if (!is_digit(stem[at])) {
      parts.skeleton += stem[at++];
      continue;
    }
    const std::size_t end = end_of_number(stem, at);
    NameNumber number = number_of(std::string_view(stem).substr(at, end - at));
    const bool has_sign = at > 0 && (stem[at - 1] == '-' || stem[at - 1] == '+');
    if (has_sign && (at < 2 || !is_digit(stem[at - 2]))) {
      number.has_plus = stem[at - 1] == '+';
      number.has_minus = !number.has_plus;
      number.may_be_dash = number.has_minus && at >= 2 && is_letter(stem[at - 2]);
      parts.skeleton.pop_back();
    }
    parts.skeleton += kNumberMark;
    parts.numbers.push_back(std::move(number));
    at = end;
  }
  parts.skeleton += suffix_of(path);
  return parts;
}

std::vector<NameGroup> group_by_name(const std::vector<std::filesystem::path>& images) {
  std::unordered_map<std::string, std::size_t> places;
  std::vector<NameGroup> groups;
  for (const std::filesystem::path& path : images) {
    NameParts parts = split_name(path);
    const auto [place, is_new] = places.try_emplace(parts.skeleton, groups.size());
    if (is_new) groups.push_back({std::move(parts.skeleton), {}});
    groups[place->second].images.push_back({path, std::move(parts.numbers)});
  }
  std::ranges::stable_sort(groups, std::ranges::greater{},
                           [](const NameGroup& group) { return group.images.size(); });
  return groups;
}

namespace {

bool is_lower(char c) {
  return c >= 'a' && c <= 'z';
}

bool is_upper(char c) {
  return c >= 'A' && c <= 'Z';
}

bool is_separator(char c) {
  return std::string_view("_- =([,.").find(c) != std::string_view::npos;
}

/// The word at the end of `text`, of "viewRow" and "view_row" the word "row".
std::string last_word(std::string_view text) {
  std::size_t begin = text.size();
  while (begin > 0 && (is_lower(text[begin - 1]) || is_upper(text[begin - 1]))) {
    --begin;
    const bool is_hump = is_upper(text[begin]) && begin > 0 && is_lower(text[begin - 1]);
    if (is_hump) break;
  }
  return lower_case(std::string(text.substr(begin)));
}

std::string first_word(std::string_view text) {
  const auto end =
      std::ranges::find_if_not(text, [](char c) { return is_lower(c) || is_upper(c); });
  return lower_case(std::string(text.begin(), end));
}

/// What stands before each number, and behind the last.
std::vector<std::string_view> between_numbers(std::string_view skeleton) {
  std::vector<std::string_view> texts;
  std::size_t begin = 0;
  for (std::size_t end; (end = skeleton.find(kNumberMark, begin)) != std::string_view::npos;) {
    texts.push_back(skeleton.substr(begin, end - begin));
    begin = end + 1;
  }
  texts.push_back(skeleton.substr(begin));
  return texts;
}

struct WordPair {
  const char* row;
  const char* column;
};
constexpr std::array kWordPairs{WordPair{"r", "c"}, WordPair{"y", "x"}, WordPair{"v", "u"},
                                WordPair{"t", "s"}};

template <std::size_t N>
bool is_one_of(const std::array<const char*, N>& words, std::string_view word) {
  return std::ranges::find(words, word) != words.end();
}

bool is_row(const std::string& word) {
  return is_one_of(std::array{"row", "rows"}, word);
}

bool is_column(const std::string& word) {
  return is_one_of(std::array{"col", "cols", "column", "columns"}, word);
}

bool is_role(const std::string& word) {
  return is_row(word) || is_column(word) ||
         std::ranges::any_of(kWordPairs, [&](const WordPair& pair) {
           return word == pair.row || word == pair.column;
         });
}

WordOrder order_of_words(const std::string& first, const std::string& second) {
  if (is_row(first) || is_column(second)) {
    return is_column(first) || is_row(second) ? WordOrder::Unknown : WordOrder::RowFirst;
  }
  if (is_column(first) || is_row(second)) return WordOrder::ColumnFirst;
  for (const auto& [row, column] : kWordPairs) {
    if (first == row && second == column) return WordOrder::RowFirst;
    if (first == column && second == row) return WordOrder::ColumnFirst;
  }
  return WordOrder::Unknown;
}

/// Whether a word of `text` begins as one of `beginnings`.
template <std::size_t N>
bool has_word(const std::string& text, const std::array<const char*, N>& beginnings) {
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char before = at == 0 ? '_' : text[at - 1];
    const bool begins_word =
        !(is_lower(before) || is_upper(before)) || (is_upper(text[at]) && is_lower(before));
    if (!begins_word) continue;
    const std::string rest = lower_case(text.substr(at, 16));
    if (std::ranges::any_of(beginnings, [&](const char* word) { return rest.starts_with(word); })) {
      return true;
    }
  }
  return false;
}

}  // namespace

NameWords::NameWords(const std::string& skeleton) {
  const std::vector<std::string_view> texts = between_numbers(skeleton);
  for (std::size_t i = 0; i + 1 < texts.size(); ++i) {
    const auto is_part_of_word = [](char c) { return !is_separator(c); };
    const auto last = std::ranges::find_if(texts[i].rbegin(), texts[i].rend(), is_part_of_word);
    before_.push_back(last_word(std::string_view(texts[i].begin(), last.base())));
    free_.push_back(texts[i].empty() ? i == 0 : is_separator(texts[i].back()));
    after_.push_back(first_word(texts[i + 1]));
  }
}

WordOrder NameWords::order_of(std::size_t first, std::size_t second) const {
  // In "3row_5col" the word before the second number belongs to the first.
  const bool are_after =
      !is_role(before_[first]) && is_role(after_[first]) && is_role(after_[second]);
  return are_after ? order_of_words(after_[first], after_[second])
                   : order_of_words(before_[first], before_[second]);
}

bool NameWords::is_other_count(std::size_t number) const {
  return is_one_of(std::array{"frame", "frames", "time", "exposure"}, before_[number]);
}

bool names_companions(const std::string& skeleton) {
  return has_word(
      skeleton, std::array{"label", "mask", "depth", "disp", "seg", "gt", "normal", "thumb", "conf",
                           "weight", "truth", "objectid", "albedo", "diffuse", "specular"});
}

bool names_mosaics(const std::string& skeleton) {
  return has_word(skeleton, std::array{"eslf", "macpi"});
}

}  // namespace episcope::io
