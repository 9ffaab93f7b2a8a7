// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/sweep/sweep_list.h"

#include "app/session/open_scene.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

std::size_t map_bytes(const std::vector<Sweep>& sweeps) {
  std::size_t bytes = 0;
  for (const Sweep& sweep : sweeps) {
    for (const SweepScene& scene : sweep.scenes) {
      for (const SweepPoint& point : scene.points) {
        if (point.estimate) bytes += byte_size(*point.estimate);
      }
    }
  }
  return bytes;
}

std::size_t point_count(const Sweep& sweep) {
  std::size_t count = 0;
  for (const SweepScene& scene : sweep.scenes) count += scene.points.size();
  return count;
}

}  // namespace

void SweepList::changed() const {
  for (const auto& listener : listeners_) listener();
}

const Sweep* SweepList::find(std::uint64_t id) const {
  const auto found = std::ranges::find(sweeps_, id, &Sweep::id);
  return found == sweeps_.end() ? nullptr : &*found;
}

Sweep* SweepList::find_own(std::uint64_t id) {
  return const_cast<Sweep*>(std::as_const(*this).find(id));
}

const SweepPoint* SweepList::find(std::uint64_t id, SweepPlace place) const {
  const Sweep* sweep = find(id);
  if (!sweep || place.scene >= sweep->scenes.size()) return nullptr;
  const auto& points = sweep->scenes[place.scene].points;
  return place.point < points.size() ? &points[place.point] : nullptr;
}

std::uint64_t SweepList::add(Sweep sweep) {
  for (SweepScene& scene : sweep.scenes) {
    for (SweepPoint& point : scene.points) point.estimate = nullptr;
  }
  sweep.id = ++last_id_;
  sweeps_.push_back(std::move(sweep));
  changed();
  return last_id_;
}

void SweepList::keep_map(SweepPoint& point, EstimatePtr map) const {
  point.estimate = nullptr;
  if (map && map_bytes(sweeps_) + byte_size(*map) <= kMapBudget) point.estimate = std::move(map);
}

void SweepList::add_point(std::uint64_t id, std::uint64_t scene, SweepPoint point) {
  Sweep* sweep = find_own(id);
  if (!sweep) return;
  const auto found = std::ranges::find(sweep->scenes, scene, &SweepScene::scene);
  if (found == sweep->scenes.end()) return;
  EstimatePtr map = std::exchange(point.estimate, nullptr);
  found->points.push_back(std::move(point));
  keep_map(found->points.back(), std::move(map));
  sweep->is_saved = false;
  changed();
}

void SweepList::set_map(std::uint64_t id, SweepPlace place, EstimatePtr map) {
  if (!find(id, place)) return;
  keep_map(find_own(id)->scenes[place.scene].points[place.point], std::move(map));
}

void SweepList::remove(std::uint64_t id) {
  if (std::erase_if(sweeps_, [id](const Sweep& each) { return each.id == id; }) > 0) changed();
}

void SweepList::mark_saved(const Sweep& written) {
  Sweep* sweep = find_own(written.id);
  if (sweep && point_count(*sweep) == point_count(written)) sweep->is_saved = true;
}

void SweepList::keep_scenes(const std::vector<std::uint64_t>& open) {
  std::size_t gone = 0;
  for (Sweep& each : sweeps_) {
    gone += std::erase_if(each.scenes, [&open](const SweepScene& part) {
      return std::ranges::count(open, part.scene) == 0;
    });
  }
  std::erase_if(sweeps_, [](const Sweep& each) { return each.scenes.empty(); });
  if (gone > 0) changed();
}

}  // namespace episcope
