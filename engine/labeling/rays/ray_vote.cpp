// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_vote.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/changed_rays.h"
#include "engine/labeling/rays/ray_targets.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

// Room for one row, of each thread.
struct Row {
  Row(int width, int label_count)
      : targets(static_cast<std::size_t>(width)),
        trusts(targets.size()),
        votes(static_cast<std::size_t>(width) * label_count) {}
  std::vector<std::int32_t> targets;
  std::vector<float> trusts;
  std::vector<float> votes;  // [x][label]
};

class Vote {
 public:
  Vote(const ViewStack<std::int32_t>& labels, const RayVotes& votes)
      : labels_(labels), votes_(votes) {}

  // Of columns of row y, the others of `out` stay as they are.
  void decide(ViewIndex view, int y, ColumnRange columns, Row& row, std::int32_t* out) const;

 private:
  void add_votes(ViewIndex view, ViewIndex other, int y, ColumnRange columns, Row& row) const;
  [[nodiscard]] float* votes_at(Row& row, int x) const {
    return row.votes.data() + static_cast<std::ptrdiff_t>(x) * votes_.label_count;
  }

  const ViewStack<std::int32_t>& labels_;
  const RayVotes& votes_;
};

void Vote::add_votes(ViewIndex view, ViewIndex other, int y, ColumnRange columns, Row& row) const {
  find_ray_targets(votes_.disparity.view(view), votes_.disparity.view(other),
                   {other.v - view.v, other.u - view.u}, y, columns, row.targets.data());
  const std::int32_t* const there = labels_.view(other).data;
  votes_.colors.trusts(votes_.colors.pair(view, y, other), columns, row.targets.data(),
                       row.trusts.data());
  for (int x = columns.begin; x < columns.end; ++x) {
    const std::int32_t target = row.targets[x];
    if (target >= 0) votes_at(row, x)[there[target]] += row.trusts[x];
  }
}

void Vote::decide(ViewIndex view, int y, ColumnRange columns, Row& row, std::int32_t* out) const {
  const ViewIndex first = labels_.first();
  const GridShape grid = labels_.grid();
  std::fill(votes_at(row, columns.begin), votes_at(row, columns.end), 0.0F);
  for (int u = first.u; u < first.u + grid.u; ++u) {
    if (u != view.u) add_votes(view, {view.v, u}, y, columns, row);
  }
  for (int v = first.v; v < first.v + grid.v; ++v) {
    if (v != view.v) add_votes(view, {v, view.u}, y, columns, row);
  }
  const std::int32_t* const here = labels_.view(view).row(y);
  for (int x = columns.begin; x < columns.end; ++x) {
    float* const votes = votes_at(row, x);
    votes[here[x]] += 1;
    const float* const most = std::max_element(votes, votes + votes_.label_count);
    out[x] = *most > votes[here[x]] ? static_cast<std::int32_t>(most - votes) : here[x];
  }
}

// The next columns with a mark from `begin` on, as many at least as rays are found for at once;
// empty if there are none.
ColumnRange next_marked(const std::uint8_t* marks, int begin, int width) {
  const auto is_marked = [marks](int from, int to) {
    return std::any_of(marks + from, marks + to, [](std::uint8_t mark) { return mark != 0; });
  };
  ColumnRange found{width, width};
  for (int x = begin; x < width; x += kRayColumns) {
    const int end = std::min(x + kRayColumns, width);
    if (is_marked(x, end)) {
      if (found.begin == width) found.begin = x;
      found.end = end;
    } else if (found.begin < width) {
      break;
    }
  }
  if (found.begin < width)
    found.begin = std::max(std::min(found.begin, found.end - kRayColumns), 0);
  return found;
}

// Calls `work(view, y, room)` for each row of each view.
template <class Work>
void for_rows(const ViewStack<std::int32_t>& labels, int label_count, const Progress& progress,
              const Work& work) {
  parallel_for_workers(labels.grid().count(), progress, [&] {
    return [&, row = Row(labels.width(), label_count)](int i) mutable {
      for (int y = 0; y < labels.height(); ++y) {
        progress.check();
        work(labels.view_at(i), y, row);
      }
    };
  });
}

}  // namespace

ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels,
                                        const RayVotes& votes, const Progress& progress) {
  const Vote vote(labels, votes);
  const int width = labels.width();
  ViewStack<std::int32_t> decided(labels.grid(), labels.height(), width, 1, labels.first());
  for_rows(labels, votes.label_count, progress, [&](ViewIndex view, int y, Row& row) {
    vote.decide(view, y, {0, width}, row, decided.view(view).row(y));
  });
  return decided;
}

ViewStack<std::int32_t> vote_again_along_rays(const ViewStack<std::int32_t>& before,
                                              const ViewStack<std::int32_t>& labels,
                                              const RayVotes& votes, const Progress& progress) {
  const ViewStack<std::uint8_t> marks =
      changed_rays(before, labels, votes.disparity, progress.part(0, 0));
  const Vote vote(labels, votes);
  const int width = labels.width();
  ViewStack<std::int32_t> decided = labels.clone();
  for_rows(labels, votes.label_count, progress, [&](ViewIndex view, int y, Row& row) {
    const std::uint8_t* const marked = marks.view(view).row(y);
    for (ColumnRange columns = next_marked(marked, 0, width); columns.begin < width;
         columns = next_marked(marked, columns.end, width)) {
      vote.decide(view, y, columns, row, decided.view(view).row(y));
    }
  });
  return decided;
}

}  // namespace episcope
