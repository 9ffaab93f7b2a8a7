// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/grid/name_parts.h"

#include "engine/core/text/suffix.h"

#include <algorithm>
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

}  // namespace episcope::io
