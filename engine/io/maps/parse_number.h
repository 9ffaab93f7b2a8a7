// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>

namespace episcope::io {

/// The finite number that the whole of `text` spells, with a dot whatever the locale.
[[nodiscard]] inline std::optional<double> parse_number(const std::string& text) {
  double value = 0;
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || begin == end || !std::isfinite(value)) return {};
  return value;
}

}  // namespace episcope::io
