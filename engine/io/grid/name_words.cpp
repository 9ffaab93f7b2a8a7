// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/name_words.h"

#include "engine/core/text/suffix.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace episcope::io {
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
constexpr std::array kPairs{WordPair{"r", "c"}, WordPair{"y", "x"}, WordPair{"v", "u"},
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
  return is_row(word) || is_column(word) || std::ranges::any_of(kPairs, [&](const WordPair& pair) {
           return word == pair.row || word == pair.column;
         });
}

WordOrder order_of_words(const std::string& first, const std::string& second) {
  if (is_row(first) || is_column(second)) {
    return is_column(first) || is_row(second) ? WordOrder::Unknown : WordOrder::RowFirst;
  }
  if (is_column(first) || is_row(second)) return WordOrder::ColumnFirst;
  for (const auto& [row, column] : kPairs) {
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
