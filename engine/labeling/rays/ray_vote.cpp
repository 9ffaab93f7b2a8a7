// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/rays/ray_vote.h"

#include "engine/core/parallel/parallel.h"
#include "engine/labeling/rays/ray_targets.h"

#include <algorithm>
#include <vector>

namespace episcope {
namespace {

class Vote {
 public:
  Vote(const ViewStack<std::int32_t>& labels, int label_count, const DisparityField& disparity,
       const RayColors& colors)
      : labels_(labels), label_count_(label_count), disparity_(disparity), colors_(colors) {}

  // Room for one row, of each thread.
  struct Row {
    Row(int width, int label_count)
        : targets(width), votes(static_cast<std::size_t>(width) * label_count) {}
    std::vector<std::int32_t> targets;
    std::vector<float> votes;  // [x][label]
  };
  void decide_view(ViewIndex view, const Progress& progress, Row& row,
                   ImageView<std::int32_t> out) const;

 private:
  void add_votes(ViewIndex view, ViewIndex other, int y, Row& row) const;

  const ViewStack<std::int32_t>& labels_;
  int label_count_;
  const DisparityField& disparity_;
  const RayColors& colors_;
};

void Vote::add_votes(ViewIndex view, ViewIndex other, int y, Row& row) const {
  find_ray_targets(disparity_.view(view), disparity_.view(other),
                   {other.v - view.v, other.u - view.u}, y, row.targets.data());
  const std::int32_t* const there = labels_.view(other).data;
  const RayColors::Pair pair = colors_.pair(view, y, other);
  for (int x = 0; x < labels_.width(); ++x) {
    const std::int32_t target = row.targets[x];
    if (target < 0) continue;
    row.votes[static_cast<std::size_t>(x) * label_count_ + there[target]] +=
        colors_.trust(pair, x, target);
  }
}

void Vote::decide_view(ViewIndex view, const Progress& progress, Row& row,
                       ImageView<std::int32_t> out) const {
  const auto here = labels_.view(view);
  const ViewIndex first = labels_.first();
  const GridShape grid = labels_.grid();
  for (int y = 0; y < here.height; ++y) {
    progress.check();
    std::fill(row.votes.begin(), row.votes.end(), 0.0F);
    for (int u = first.u; u < first.u + grid.u; ++u) {
      if (u != view.u) add_votes(view, {view.v, u}, y, row);
    }
    for (int v = first.v; v < first.v + grid.v; ++v) {
      if (v != view.v) add_votes(view, {v, view.u}, y, row);
    }
    for (int x = 0; x < here.width; ++x) {
      float* const votes = row.votes.data() + static_cast<std::ptrdiff_t>(x) * label_count_;
      const std::int32_t own = here.at(y, x);
      votes[own] += 1;
      const float* const most = std::max_element(votes, votes + label_count_);
      out.at(y, x) = *most > votes[own] ? static_cast<std::int32_t>(most - votes) : own;
    }
  }
}

}  // namespace

ViewStack<std::int32_t> vote_along_rays(const ViewStack<std::int32_t>& labels, int label_count,
                                        const DisparityField& disparity, const RayColors& colors,
                                        const Progress& progress) {
  const Vote vote(labels, label_count, disparity, colors);
  ViewStack<std::int32_t> decided(labels.grid(), labels.height(), labels.width(), 1,
                                  labels.first());
  parallel_for_workers(labels.grid().count(), progress, [&] {
    return [&, row = Vote::Row(labels.width(), label_count)](int i) mutable {
      const ViewIndex view = labels.view_at(i);
      vote.decide_view(view, progress, row, decided.view(view));
    };
  });
  return decided;
}

}  // namespace episcope
