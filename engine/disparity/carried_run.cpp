// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/carried_run.h"

#include "engine/core/memory.h"
#include "engine/disparity/propagate_planes.h"
#include "engine/disparity/view_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope {
namespace {

// The corners of the grid but the first view: the views that see most of what it does not.
std::vector<ViewIndex> outermost_views(const CarriedMethod& method, GridShape grid) {
  std::vector<ViewIndex> views;
  if (!method.has_corners()) return views;
  const ViewIndex from = method.first_view();
  for (const int v : {0, grid.v - 1}) {
    for (const int u : {0, grid.u - 1}) {
      const ViewIndex view{v, u};
      if (view != from && std::ranges::find(views, view) == views.end()) views.push_back(view);
    }
  }
  return views;
}

ViewStack<float> rows_of_all(const MapGeometry& maps, int rows) {
  return {maps.grid, rows, maps.width, 1, maps.first};
}

void copy_rows(ImageView<const float> from, int from_row, int rows, float* to) {
  std::copy_n(from.row(from_row), static_cast<std::size_t>(rows) * from.width, to);
}

class CarriedBlocks {
 public:
  CarriedBlocks(const LightField& light_field, std::unique_ptr<CarriedMethod> method,
                ViewSelection selection, int threads)
      : lf_(light_field),
        method_(std::move(method)),
        from_(method_->first_view()),
        threads_(threads),
        range_(method_->range()) {
    views_ = {from_};
    maps_ = {{1, 1}, from_, lf_.height(), lf_.width()};
    if (selection == ViewSelection::Center || lf_.grid().count() == 1) return;
    maps_ = {lf_.grid(), {}, lf_.height(), lf_.width()};
    for (const ViewIndex view : outermost_views(*method_, lf_.grid())) views_.push_back(view);
  }

  [[nodiscard]] const MapGeometry& maps() const { return maps_; }
  [[nodiscard]] Interval range() const { return range_; }
  // Those that are estimated.
  [[nodiscard]] const std::vector<ViewIndex>& views() const { return views_; }

  [[nodiscard]] FinishedBlock estimate(ViewIndex view, const ReadBlock& read,
                                       const std::vector<double>& facts, const Progress& progress) {
    const MemorySetAside aside(static_cast<std::size_t>(bytes_of_view()));
    FinishedBlock made;
    if (view == from_) {
      known_.push_back(method_->estimate_first(progress));
      made.notes = known_.back().notes;
      made.facts = method_->facts();
    } else {
      restore(facts, progress.part(0, 0.02));
      const auto before = std::ranges::find(views_, view) - views_.begin();
      load(static_cast<std::size_t>(before), read);
      known_.push_back(method_->estimate_next(view, known_, progress.part(0.02, 1)));
    }
    is_restored_ = true;
    made.maps.field.disparity = known_.back().field.disparity.clone();
    made.maps.confidence = known_.back().confidence.clone();
    if (maps_.grid.count() == 1) made.maps.second = std::move(known_.back().second);
    return made;
  }

  [[nodiscard]] FinishedBlock carry(const MapBlock& block, const ReadBlock& read,
                                    const Progress& progress) {
    load(views_.size(), read);
    PropagatedMaps carried = propagate_to_views(known_, block.views, progress);
    for (const Estimate& map : known_) put_map(map, 0, carried.disparity, carried.confidence);
    return {{{std::move(carried.disparity), {}}, std::move(carried.confidence)}};
  }

  [[nodiscard]] FinishedBlock choose(const MapBlock& block, const ReadBlock& read,
                                     const std::vector<double>& facts, const Progress& progress) {
    load(views_.size(), read);
    restore(facts, progress.part(0, 0.02));
    begin_sides(progress.part(0.02, 0.05));
    const int first = std::max(block.first_row - reach_, 0);
    const int end = std::min(block.end_row + reach_, maps_.height);
    const LightField& compared = method_->compared();
    compared.fetch_samples(first, end);
    const ViewStack<float> before = rows_before(first, block.first_row, end, read, progress);
    const PackedViews packed = pack_rows(compared, first, end, progress.part(0.1, 0.2));
    FinishedBlock made{read(block)};
    choose_propagated_sides({packed, before, first, maps_.height}, cap_, block.first_row,
                            made.maps.field.disparity, progress.part(0.2, 1));
    for (const Estimate& map : known_) {
      put_map(map, block.first_row, made.maps.field.disparity, made.maps.confidence);
    }
    keep(before, first, std::max(block.end_row - reach_, first), block.end_row);
    return made;
  }

  // Beside large arrays.
  [[nodiscard]] double bytes_of_view() const {
    return method_->bytes_of_view() + pixels() * kOfMap * static_cast<double>(views_.size());
  }
  [[nodiscard]] double bytes_of_carried(int count) const {
    const auto known = static_cast<double>(views_.size());
    const double shown = kOfMap * known + sizeof(float);
    return pixels() * (kOfMap * (known + count) + shown * std::min(count, threads_));
  }
  [[nodiscard]] double bytes_of_bands(int rows) const {
    const double farthest = std::max(std::abs(range_.min), std::abs(range_.max)) + 0.5;
    const int reach = propagated_reach(maps_.grid, farthest);
    const double band = std::min(rows + 2 * reach, maps_.height);
    const double rays = static_cast<double>(maps_.grid.count()) * maps_.width;
    const double sample =
        static_cast<double>(lf_.byte_size()) / static_cast<double>(maps_.grid.count()) / pixels();
    const double looked_at = lf_.is_on_disk() ? sample : 0;
    constexpr double kBeforeAndRead = 12, kMade = 9, kKept = 4;
    return pixels() * (kOfMap + sizeof(float)) * static_cast<double>(views_.size()) +
           rays * ((kBeforeAndRead + looked_at) * band + kMade * rows + kKept * reach);
  }

 private:
  static constexpr double kOfMap = 8;

  [[nodiscard]] double pixels() const { return static_cast<double>(maps_.height) * maps_.width; }

  // The light field as it is compared.
  void restore(const std::vector<double>& facts, const Progress& progress) {
    if (!is_restored_) method_->restore(facts, progress);
    is_restored_ = true;
  }

  // The first maps, as far as this program has not made them.
  void load(std::size_t count, const ReadBlock& read) {
    while (known_.size() < count) {
      const ViewIndex view = views_[known_.size()];
      BlockMaps stored = read({{view, {1, 1}}, 0, maps_.height});
      Estimate map;
      map.range = range_;
      map.field = std::move(stored.field);
      map.confidence = std::move(stored.confidence);
      known_.push_back(std::move(map));
    }
  }

  [[nodiscard]] ViewStack<float> carried_disparity(ViewIndex view, const Progress& progress) const {
    return propagate_to_views(known_, {view, {1, 1}}, progress).disparity;
  }

  // What all bands have in common.
  void begin_sides(const Progress& progress) {
    if (reach_ > 0) return;
    double farthest = 0;
    for (const Estimate& map : known_) {
      const ViewStack<float>& disparity = map.field.disparity;
      for (std::size_t i = 0; i < disparity.size(); ++i) {
        farthest = std::max<double>(farthest, std::abs(disparity.data()[i]));
      }
      carried_.push_back(carried_disparity(disparity.first(), progress.part(0, 0)));
    }
    cap_ = propagated_cap(method_->compared(), from_, progress);
    reach_ = propagated_reach(maps_.grid, farthest);
  }

  // Carried maps of all views, rows [first, end), of which those before `replaced` may be lost.
  [[nodiscard]] ViewStack<float> rows_before(int first, int replaced, int end,
                                             const ReadBlock& read,
                                             const Progress& progress) const {
    const ViewStack<float> stored =
        read({{maps_.first, maps_.grid}, replaced, end}).field.disparity;
    const bool is_kept = !kept_.empty() && kept_first_ <= first && kept_end_ == replaced;
    ViewStack<float> before = rows_of_all(maps_, end - first);
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      const ImageView<float> out = before.view(view);
      copy_rows(stored.view(view), 0, end - replaced, out.row(replaced - first));
      if (first == replaced) continue;
      if (is_kept) {
        copy_rows(kept_.view(view), first - kept_first_, replaced - first, out.row(0));
      } else {
        const ViewStack<float> again = carried_disparity(view, progress.part(0.05, 0.05));
        copy_rows(again.view(view), first, replaced - first, out.row(0));
      }
    }
    // Views that were estimated are stored as they were, not as they are carried.
    for (const ViewStack<float>& carried : carried_) {
      copy_rows(carried.view(carried.first()), first, end - first,
                before.view(carried.first()).row(0));
    }
    return before;
  }

  // Rows that the next band looks at.
  void keep(const ViewStack<float>& before, int first, int keep_first, int keep_end) {
    kept_ = rows_of_all(maps_, keep_end - keep_first);
    kept_first_ = keep_first;
    kept_end_ = keep_end;
    for (int i = 0; i < maps_.grid.count(); ++i) {
      const ViewIndex view = maps_.grid.view_at(i);
      copy_rows(before.view(view), keep_first - first, keep_end - keep_first,
                kept_.view(view).row(0));
    }
  }

  const LightField& lf_;
  std::unique_ptr<CarriedMethod> method_;
  ViewIndex from_;
  int threads_;
  Interval range_;
  MapGeometry maps_;
  std::vector<ViewIndex> views_;
  bool is_restored_ = false;
  std::vector<Estimate> known_;  // Of the first of `views_`.
  // Of the choice of sides: what known maps are where they are carried to their own views, and rows
  // that were replaced.
  std::vector<ViewStack<float>> carried_;
  float cap_ = 0;
  int reach_ = 0;
  ViewStack<float> kept_;
  int kept_first_ = 0, kept_end_ = 0;
};

using SharedBlocks = std::shared_ptr<CarriedBlocks>;

BlockPass estimating(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "estimating views";
  pass.unit = BlockUnit::Views;
  pass.only = blocks->views();
  pass.bytes = [blocks](int) { return blocks->bytes_of_view(); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return blocks->estimate(block.views.first, read, facts, progress);
  };
  return pass;
}

BlockPass carrying(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "propagating to other views";
  pass.unit = BlockUnit::Views;
  pass.bytes = [blocks](int count) { return blocks->bytes_of_carried(count); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                          const Progress& progress) {
    return blocks->carry(block, read, progress);
  };
  return pass;
}

BlockPass choosing(const SharedBlocks& blocks) {
  BlockPass pass;
  pass.step = "choosing sides";
  pass.bytes = [blocks](int rows) { return blocks->bytes_of_bands(rows); };
  pass.compute = [blocks](const MapBlock& block, const ReadBlock& read,
                          const std::vector<double>& facts, const Progress& progress) {
    return blocks->choose(block, read, facts, progress);
  };
  return pass;
}

// Changes nothing: the last pass marks invalid pixels, whose values the choice of sides needs until
// it has ended.
BlockPass marking(const MapGeometry& maps) {
  BlockPass pass;
  pass.step = "marking invalid pixels";
  pass.bytes = [maps](int rows) {
    constexpr double kMaps = 9;
    return kMaps * rows * maps.width * maps.grid.count();
  };
  pass.compute = [](const MapBlock& block, const ReadBlock& read, const std::vector<double>&,
                    const Progress&) { return FinishedBlock{read(block)}; };
  return pass;
}

// Maps of all views from those of some.
Estimate carried_to_all(const LightField& compared, const std::vector<Estimate>& maps,
                        const Progress& progress) {
  PropagatedMaps carried = propagate_to_views(maps, {{}, compared.grid()}, progress.part(0, 0.2));
  const Estimate& first = maps.front();
  Estimate estimate;
  estimate.set_provenance(first.provenance());
  estimate.field.disparity = std::move(carried.disparity);
  estimate.confidence = std::move(carried.confidence);
  const PackedViews packed = pack_views(compared, progress.part(0.2, 0.3));
  const float cap =
      propagated_cap(compared, first.field.disparity.first(), progress.part(0.3, 0.31));
  choose_propagated_sides(packed, cap, estimate, progress.part(0.31, 1));
  for (const Estimate& map : maps) put_map(map, 0, estimate.field.disparity, estimate.confidence);
  estimate.notes.push_back(propagated_note(maps.size()));
  return estimate;
}

}  // namespace

Estimate run_carried(CarriedMethod& method, ViewSelection views, const Progress& progress) {
  const GridShape grid = method.compared().grid();
  if (views == ViewSelection::Center || grid.count() == 1) return method.estimate_first(progress);
  const std::vector<ViewIndex> corners = outermost_views(method, grid);
  const double next = method.share_of_next();
  const double share = 0.9 / (1 + next * static_cast<double>(corners.size()));
  std::vector<Estimate> maps;
  maps.push_back(method.estimate_first(progress.part(0, share)));
  for (std::size_t i = 0; i < corners.size() && !progress.finish_requested(); ++i) {
    const auto done = static_cast<double>(i);
    maps.push_back(method.estimate_next(
        corners[i], maps,
        progress.part(share * (1 + next * done), share * (1 + next * (done + 1)))));
  }
  return carried_to_all(method.compared(), maps, progress.part(0.9, 1));
}

BlockwiseRun carried_in_blocks(const LightField& lf, std::unique_ptr<CarriedMethod> method,
                               ViewSelection views, int threads) {
  const auto blocks = std::make_shared<CarriedBlocks>(lf, std::move(method), views, threads);
  BlockwiseRun run;
  run.maps = blocks->maps();
  run.provenance.range = blocks->range();
  run.passes.push_back(estimating(blocks));
  const std::size_t estimated = blocks->views().size();
  if (run.maps.grid.count() == 1) return run;
  run.passes.push_back(carrying(blocks));
  run.passes.push_back(choosing(blocks));
  if (!lf.valid().empty()) run.passes.push_back(marking(run.maps));
  run.notes = [estimated](const BlockProgress&) { return std::vector{propagated_note(estimated)}; };
  return run;
}

}  // namespace episcope
