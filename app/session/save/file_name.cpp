// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/save/file_name.h"

#include "engine/core/text/character.h"

#include <algorithm>
#include <functional>
#include <string_view>

namespace episcope {
namespace {

constexpr std::size_t kLongest = 80;
constexpr std::string_view kRefused = "/\\:*?\"<>|";

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

/// Bytes of the character that begins with this one in UTF-8; 0 if none does.
std::size_t length_of_character(char first) {
  const auto code = static_cast<unsigned char>(first);
  if (is_ascii(first)) return 1;
  if (code >= 0xC2 && code < 0xE0) return 2;
  if (code >= 0xE0 && code < 0xF0) return 3;
  return code >= 0xF0 && code < 0xF5 ? 4 : 0;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = length_of_character(text.front());
    if (length == 0 || length > text.size()) return false;
    const std::string_view rest = text.substr(1, length - 1);
    if (!std::ranges::all_of(rest, continues_character)) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::string file_name_of(std::string name) {
  if (!is_utf8(name)) std::ranges::replace_if(name, std::not_fn(is_ascii), '_');
  std::ranges::replace_if(
      name, [](char each) { return kRefused.find(each) != std::string_view::npos; }, '_');
  if (name.size() <= kLongest) return name;
  std::size_t length = kLongest;
  while (continues_character(name[length])) --length;
  return name.substr(0, length);
}

}  // namespace episcope
