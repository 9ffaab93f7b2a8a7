// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_vote.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

namespace episcope {
namespace {

// Room for one row, of each thread.
struct VoteRow {
  VoteRow(int width, int label_count)
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
  void decide(ViewIndex view, int y, ColumnRange columns, VoteRow& row, std::int32_t* out) const;

 private:
  void add_votes(ViewIndex view, ViewIndex other, int y, ColumnRange columns, VoteRow& row) const;
  [[nodiscard]] float* votes_at(VoteRow& row, int x) const {
    return row.votes.data() + static_cast<std::ptrdiff_t>(x) * votes_.label_count;
  }

  const ViewStack<std::int32_t>& labels_;
  const RayVotes& votes_;
};

void Vote::add_votes(ViewIndex view, ViewIndex other, int y, ColumnRange columns,
                     VoteRow& row) const {
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

void Vote::decide(ViewIndex view, int y, ColumnRange columns, VoteRow& row,
                  std::int32_t* out) const {
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

// Calls `work(view, y, room)` for each row of each view.
template <class Work>
void for_rows(const ViewStack<std::int32_t>& labels, int label_count, const Progress& progress,
              const Work& work) {
  parallel_for_workers(labels.grid().count(), progress, [&] {
    return [&, row = VoteRow(labels.width(), label_count)](int i) mutable {
      for (int y = 0; y < labels.height(); ++y) {
        progress.check();
        work(labels.view_at(i), y, row);
      }
    };
  });
}

struct Pixel {
  int y = 0, x = 0;
};

std::vector<Pixel> differing(ImageView<const std::int32_t> before,
                             ImageView<const std::int32_t> after) {
  std::vector<Pixel> found;
  for (int y = 0; y < before.height; ++y) {
    for (int x = 0; x < before.width; ++x) {
      if (before.at(y, x) != after.at(y, x)) found.push_back({y, x});
    }
  }
  return found;
}

// The pixels, at least 0 and below `size`, whose rays may arrive at `at` of the view `step` away.
std::pair<int, int> sources(int at, float disparity, int step, int size) {
  const float center = static_cast<float>(at) + disparity * static_cast<float>(step);
  // Half a pixel of rounding, and some for that of floats.
  const float reach = 0.51F + kSamePointTolerance_px * static_cast<float>(std::abs(step));
  const float last = static_cast<float>(size - 1);
  if (!(center + reach >= 0 && center - reach <= last)) return {0, 0};
  return {static_cast<int>(std::ceil(std::max(center - reach, 0.0F))),
          static_cast<int>(std::floor(std::min(center + reach, last))) + 1};
}

void mark(const std::vector<Pixel>& changed, const DisparityView& there, ViewIndex step,
          ImageView<std::uint8_t> marks) {
  for (const Pixel& at : changed) {
    const float disparity = there.disparity.at(at.y, at.x);
    if (!std::isfinite(disparity) || !there.is_valid(at.y, at.x)) continue;
    const auto [top, bottom] = sources(at.y, disparity, step.v, marks.height);
    const auto [left, right] = sources(at.x, disparity, step.u, marks.width);
    for (int y = top; y < bottom; ++y) std::fill(marks.row(y) + left, marks.row(y) + right, 1);
  }
}

}  // namespace

ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels,
                                        const RayVotes& votes, const Progress& progress) {
  const Vote vote(labels, votes);
  const int width = labels.width();
  ViewStack<std::int32_t> decided(labels.grid(), labels.height(), width, 1, labels.first());
  for_rows(labels, votes.label_count, progress, [&](ViewIndex view, int y, VoteRow& row) {
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
  for_rows(labels, votes.label_count, progress, [&](ViewIndex view, int y, VoteRow& row) {
    for (const ColumnRange columns : marked_columns(marks.view(view).row(y), width)) {
      vote.decide(view, y, columns, row, decided.view(view).row(y));
    }
  });
  return decided;
}

ViewStack<std::uint8_t> changed_rays(const ViewStack<std::int32_t>& before,
                                     const ViewStack<std::int32_t>& after,
                                     const DisparityField& disparity, const Progress& progress) {
  const GridShape grid = before.grid();
  ViewStack<std::uint8_t> marks(grid, before.height(), before.width(), 1, before.first(),
                                allocate_large_zeros);
  std::vector<std::vector<Pixel>> changed(static_cast<std::size_t>(grid.count()));
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = before.view_at(i);
    changed[static_cast<std::size_t>(i)] = differing(before.view(view), after.view(view));
  });
  parallel_for(grid.count(), progress, [&](int i) {
    const ViewIndex view = before.view_at(i);
    const ImageView<std::uint8_t> here = marks.view(view);
    for (const Pixel& own : changed[static_cast<std::size_t>(i)]) here.at(own.y, own.x) = 1;
    for (int j = 0; j < grid.count(); ++j) {
      const ViewIndex other = before.view_at(j);
      if (other == view || (other.v != view.v && other.u != view.u)) continue;
      mark(changed[static_cast<std::size_t>(j)], disparity.view(other),
           {other.v - view.v, other.u - view.u}, here);
    }
  });
  return marks;
}

}  // namespace episcope
