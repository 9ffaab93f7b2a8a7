// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"

#include <string>
#include <utility>
#include <vector>

namespace episcope {

/// Pairs of points that a user picks, with every change undoable.
class PickedPairs {
 public:
  PickedPairs() = default;
  /// As they were when a project was saved.
  explicit PickedPairs(std::vector<capture::PointPair> pairs) : pairs_(std::move(pairs)) {}

  [[nodiscard]] const std::vector<capture::PointPair>& all() const { return pairs_; }
  [[nodiscard]] bool is_undoable() const { return !former_.empty(); }

  /// Names that are empty or taken get a number.
  void add(std::vector<capture::PointPair> pairs);
  /// Locked pairs stay.
  void remove(const std::vector<int>& places);
  void lock(int place, bool is_locked);
  /// Ignored if the name is empty, taken, or holds what a CSV file cannot.
  void rename(int place, const std::string& name);
  void undo();
  /// All is forgotten, the history too.
  void clear();

 private:
  [[nodiscard]] bool has(const std::string& name) const;
  void remember() { former_.push_back(pairs_); }

  std::vector<capture::PointPair> pairs_;
  std::vector<std::vector<capture::PointPair>> former_;
};

}  // namespace episcope
