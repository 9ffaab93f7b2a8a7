// SPDX-License-Identifier: BSD-3-Clause
#include "engine/scenes/recipes/scribble.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <vector>

namespace episcope::scenes {
namespace {

// A run of one label along a row or a column.
struct Run {
  int line = 0;
  int begin = 0;
  int length = 0;
};

using RunsByLabel = std::map<std::int32_t, std::vector<Run>>;

// The longest run of every label in each line; `at(line, i)` is the label at place `i` of a line.
template <class At>
RunsByLabel longest_runs(int lines, int length, const At& at) {
  RunsByLabel runs;
  for (int line = 0; line < lines; ++line) {
    for (int begin = 0; begin < length;) {
      int end = begin + 1;
      while (end < length && at(line, end) == at(line, begin)) ++end;
      auto& found = runs[at(line, begin)];
      if (found.empty() || found.back().line != line) found.push_back({line, begin, 0});
      if (end - begin > found.back().length) found.back() = {line, begin, end - begin};
      begin = end;
    }
  }
  return runs;
}

// The middle one of the long runs: long, and clear of the outline.
Run middle_run(const std::vector<Run>& runs) {
  const auto shorter = [](const Run& a, const Run& b) { return a.length < b.length; };
  const int longest = std::max_element(runs.begin(), runs.end(), shorter)->length;
  std::vector<Run> is_long;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(is_long),
               [longest](const Run& run) { return run.length >= longest * 3 / 4; });
  return is_long[is_long.size() / 2];
}

// Calls `paint(line, i)` for the middle half of the run, `thickness` lines wide.
template <class Paint>
void stroke(const Run& run, int thickness, const Paint& paint) {
  for (int i = run.begin + run.length / 4; i < run.begin + run.length * 3 / 4; ++i) {
    for (int offset = -thickness / 2; offset <= thickness / 2; ++offset) {
      paint(run.line + offset, i);
    }
  }
}

}  // namespace

Image<std::int32_t> scribble(ImageView<const std::int32_t> labels) {
  Image<std::int32_t> painted(labels.height, labels.width);
  const int thickness = std::max(1, std::max(labels.height, labels.width) / 128);
  const auto paint = [&](int y, int x, std::int32_t label) {
    if (y < 0 || y >= labels.height || x < 0 || x >= labels.width) return;
    if (labels.at(y, x) == label) painted.at(y, x) = label;
  };
  const auto rows =
      longest_runs(labels.height, labels.width, [&](int y, int x) { return labels.at(y, x); });
  const auto columns =
      longest_runs(labels.width, labels.height, [&](int x, int y) { return labels.at(y, x); });
  for (const auto& entry : rows) {
    const std::int32_t label = entry.first;
    stroke(middle_run(entry.second), thickness, [&](int y, int x) { paint(y, x, label); });
  }
  for (const auto& entry : columns) {
    const std::int32_t label = entry.first;
    stroke(middle_run(entry.second), thickness, [&](int x, int y) { paint(y, x, label); });
  }
  return painted;
}

}  // namespace episcope::scenes
