// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/capture/picked_pairs.h"

#include <algorithm>
#include <utility>

namespace episcope {

bool PickedPairs::has(const std::string& name) const {
  return std::ranges::find(pairs_, name, &capture::PointPair::name) != pairs_.end();
}

void PickedPairs::add(std::vector<capture::PointPair> pairs) {
  if (pairs.empty()) return;
  remember();
  for (capture::PointPair& pair : pairs) {
    const std::string stem = pair.name;
    for (int number = stem.empty() ? 1 : 2; pair.name.empty() || has(pair.name); ++number) {
      pair.name = stem.empty() ? std::to_string(number) : stem + " " + std::to_string(number);
    }
    pairs_.push_back(std::move(pair));
  }
}

void PickedPairs::remove(const std::vector<int>& places) {
  const auto is_locked = [this](int place) { return pairs_[place].is_locked; };
  if (std::ranges::all_of(places, is_locked)) return;
  remember();
  for (auto place = places.rbegin(); place != places.rend(); ++place) {
    if (!is_locked(*place)) pairs_.erase(pairs_.begin() + *place);
  }
}

void PickedPairs::lock(int place, bool is_locked) {
  if (pairs_[place].is_locked == is_locked) return;
  remember();
  pairs_[place].is_locked = is_locked;
}

void PickedPairs::rename(int place, const std::string& name) {
  if (name.empty() || has(name) || name.find_first_of(",\n\r") != std::string::npos) return;
  remember();
  pairs_[place].name = name;
}

void PickedPairs::undo() {
  if (former_.empty()) return;
  pairs_ = std::move(former_.back());
  former_.pop_back();
}

void PickedPairs::clear() {
  pairs_.clear();
  former_.clear();
}

}  // namespace episcope
