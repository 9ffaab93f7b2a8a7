// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/grid_option.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <charconv>

namespace episcope::io {
namespace {

constexpr int kMostViews = 1000000;

/// A whole number from 1 on that begins at `at`, which moves behind it; 0 if there is none.
int take_count(const std::string& text, std::size_t& at) {
  int value = 0;
  const char* begin = text.data() + at;
  const auto [stop, error] = std::from_chars(begin, text.data() + text.size(), value);
  if (error != std::errc() || value < 1 || value > kMostViews) return 0;
  at += static_cast<std::size_t>(stop - begin);
  return value;
}

}  // namespace

std::string grid_text(GridShape grid) {
  return fmt::format("{}×{}", grid.v, grid.u);
}

GridShape parse_grid(const std::string& text) {
  std::size_t at = 0;
  GridShape grid;
  grid.v = take_count(text, at);
  for (const std::string_view times : {"x", "X", "×"}) {
    if (!std::string_view(text).substr(at).starts_with(times)) continue;
    at += times.size();
    grid.u = take_count(text, at);
    break;
  }
  if (grid.v < 1 || grid.u < 1 || at != text.size() || grid.v > kMostViews / grid.u) {
    throw InvalidInput("'" + text +
                       "' is no grid of views; give rows x columns, as in 9x9, or 1x49 for a scan "
                       "along a line");
  }
  return grid;
}

std::optional<GridShape> given_grid(const OpenOptions& options) {
  if (options.grid.empty()) return std::nullopt;
  return parse_grid(options.grid);
}

}  // namespace episcope::io
