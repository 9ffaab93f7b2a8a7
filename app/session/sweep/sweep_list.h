// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/sweep/sweep.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace episcope {

/// A point of a sweep.
struct SweepPlace {
  std::size_t scene = 0;  ///< Among Sweep::scenes.
  std::size_t point = 0;
  friend bool operator==(const SweepPlace&, const SweepPlace&) = default;
};

/// The sweeps over open scenes. Unknown ids and places are ignored.
class SweepList {
 public:
  /// Maps beyond it are computed again when they are asked for: 64 of 512×512 px fit.
  static constexpr std::size_t kMapBudget = std::size_t{256} << 20;

  /// After every change that a project would keep. Listeners live as long as this.
  void on_changed(std::function<void()> listener) { listeners_.push_back(std::move(listener)); }

  [[nodiscard]] const std::vector<Sweep>& all() const { return sweeps_; }
  /// Null for an unknown id.
  [[nodiscard]] const Sweep* find(std::uint64_t id) const;
  /// Null for one that is not there.
  [[nodiscard]] const SweepPoint* find(std::uint64_t id, SweepPlace place) const;

  /// Returns the id that it is given. Of `sweep`, maps are not kept.
  std::uint64_t add(Sweep sweep);
  /// The next point of a scene. Its map is kept as far as there is room.
  void add_point(std::uint64_t id, std::uint64_t scene, SweepPoint point);
  /// The map of a point was computed again.
  void set_map(std::uint64_t id, SweepPlace place, EstimatePtr map);
  void remove(std::uint64_t id);
  /// A file of the user's holds one as it was; ignored if points came since.
  void mark_saved(const Sweep& written);
  /// Scenes were closed: what was found on those that are not `open` any more goes with them.
  void keep_scenes(const std::vector<std::uint64_t>& open);

 private:
  [[nodiscard]] Sweep* find_own(std::uint64_t id);
  void changed() const;
  void keep_map(SweepPoint& point, EstimatePtr map) const;

  std::vector<std::function<void()>> listeners_;
  std::vector<Sweep> sweeps_;
  std::uint64_t last_id_ = 0;
};

}  // namespace episcope
