// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace episcope {

/// Joins the texts that `text_of`, a callable or a member, returns for the items, with `separator`
/// between them: "a, b, c".
template <class Items, class TextOf = std::identity>
[[nodiscard]] std::string joined(const Items& items, std::string_view separator,
                                 const TextOf& text_of = {}) {
  std::string text;
  bool is_first = true;
  for (const auto& item : items) {
    if (!is_first) text += separator;
    is_first = false;
    text += std::invoke(text_of, item);
  }
  return text;
}

/// Without the characters of `blanks` at its beginning and its end.
[[nodiscard]] inline std::string_view trimmed(std::string_view text,
                                              std::string_view blanks = " \t\r") {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

/// What surrounds a cell of a table that may be quoted.
inline constexpr std::string_view kQuotesAndBlanks = " \t\r\"";

/// One of 0 … 9.
[[nodiscard]] inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// One of a … z, A … Z.
[[nodiscard]] inline bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// A letter in lower case; other characters as they are.
[[nodiscard]] inline char lower_case(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Whether a byte continues a character of UTF-8, i.e. is not its first.
[[nodiscard]] inline bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// The place behind the digits that begin at `at`; `at` itself if there are none.
[[nodiscard]] inline std::size_t end_of_digits(std::string_view text, std::size_t at) {
  while (at < text.size() && is_digit(text[at])) ++at;
  return at;
}

/// `wanted`, followed by `separator` and the first free number from 2 on where that name is taken.
template <class IsTaken>
[[nodiscard]] std::string unique_name(const std::string& wanted, const char* separator,
                                      const IsTaken& is_taken) {
  std::string name = wanted;
  for (int number = 2; is_taken(name); ++number) {
    name = wanted + separator + std::to_string(number);
  }
  return name;
}

/// ASCII letters in lower case.
[[nodiscard]] inline std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) { return lower_case(c); });
  return text;
}

/// The extension of a file name in lower case, with its dot: ".h5".
[[nodiscard]] inline std::string suffix_of(const std::filesystem::path& path) {
  return lower_case(path.extension().string());
}

}  // namespace episcope
