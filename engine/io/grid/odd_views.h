// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/load_views.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::io {

/// A view that cannot be used with the others.
struct OddView {
  int place = 0;    ///< Among the files of the views.
  std::string why;  ///< "the image cannot be decoded: …", "this view has 8×8 px, …".
  bool is_damaged = false;
};

/// What more than half of those have that are known; nothing if there is no such thing.
template <class T>
[[nodiscard]] std::optional<T> majority(const std::vector<std::optional<T>>& each) {
  std::map<T, std::size_t> counts;
  std::size_t known = 0;
  for (const std::optional<T>& one : each) {
    if (!one) continue;
    ++counts[*one];
    ++known;
  }
  for (const auto& [value, count] : counts) {
    if (2 * count > known) return value;
  }
  return std::nullopt;
}

/// What is left of views without some of them.
struct PartWithout {
  ViewFiles views;
  PartOfGrid kept;      ///< Of the grid of all.
  std::string warning;  ///< Which were left out and why, and which part is left.
};

/// Views that cannot be used are as good as missing: the largest part of the grid without them, in
/// equal steps (`part_to_open`). Nothing if that is too small.
[[nodiscard]] std::optional<PartWithout> without_views(const ViewFiles& views,
                                                       const std::vector<OddView>& odd);

}  // namespace episcope::io
