// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/epi/ordering_sweeps.h"

#include "engine/core/parallel/parallel.h"
#include "engine/disparity/common/smoothness_weights.h"
#include "engine/solvers/tv_l2/tv_l2.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

// Improves one view after the other; one per thread.
class ViewStep {
 public:
  explicit ViewStep(const OrderedViews& work)
      : work_(work),
        solver_(work.u.height(), work.u.width()),
        weights_(work.u.height(), work.u.width()),
        observed_(weights_.height(), weights_.width()),
        curvature_(weights_.height(), weights_.width()),
        force_(weights_.height(), weights_.width()) {}

  // Returns the relative gap.
  double improve(ViewIndex view, const Progress& progress) {
    pull_from_neighbours(view, progress);
    majorise(view);
    const DenoiseParameters& parameters = work_.parameters.denoising;
    const Image<float> edges =
        smoothness_weights(work_.light_field, view, parameters.edge_strength);
    return solver_
        .solve({observed_, weights_, edges, parameters.lambda},
               {parameters.stop.max_iterations, parameters.stop.gap}, progress, work_.u.view(view))
        .relative_gap();
  }

 private:
  void pull_from_neighbours(ViewIndex view, const Progress& progress) {
    std::fill(curvature_.begin(), curvature_.end(), 0.0F);
    std::fill(force_.begin(), force_.end(), 0.0F);
    const ImageView<const float> here = std::as_const(work_.u).view(view);
    const OrderingPull pull{curvature_.view(), force_.view()};
    for_each_neighbour(work_, view, [&](ViewIndex other, ViewIndex way) {
      const ImageView<const float> there = std::as_const(work_.u).view(other);
      progress.check();
      add_pull_on_from(here, here, there, step_along(way), work_.penalty(), pull);
      const ViewIndex back{-way.v, -way.u};
      add_pull_on_to(there, there, here, step_along(back), work_.penalty(), pull);
    });
  }

  // ½ w (u − f)² and the majoriser as one weighted observation.
  void majorise(ViewIndex view) {
    fill_data_weights(work_.confidence.view(view),
                      {work_.parameters.denoising.weight_power, kOrderingLeastWeight}, weights_);
    const float* const f = work_.f.view(view).data;
    const float* const u = work_.u.view(view).data;
    for (std::size_t i = 0; i < weights_.size(); ++i) {
      const float w = weights_.data()[i], c = curvature_.data()[i];
      observed_.data()[i] = (w * f[i] + c * u[i] + force_.data()[i]) / (w + c);
      weights_.data()[i] = w + c;
    }
  }

  const OrderedViews& work_;
  TvL2Solver solver_;
  Image<float> weights_, observed_, curvature_, force_;
};

}  // namespace

OrderingPenalty OrderedViews::penalty() const {
  return {static_cast<float>(std::min(parameters.rise, parameters.fall)),
          static_cast<float>(parameters.fall), static_cast<float>(parameters.softness)};
}

std::vector<ViewIndex> views_of_colour(const ViewRectangle& rectangle, int colour) {
  std::vector<ViewIndex> views;
  for (int i = 0; i < rectangle.grid.count(); ++i) {
    const ViewIndex view = rectangle.grid.view_at(i, rectangle.first);
    if ((view.u + view.v) % 2 == colour) views.push_back(view);
  }
  return views;
}

double improve(const OrderedViews& work, const std::vector<ViewIndex>& views,
               const Progress& progress) {
  std::vector<double> gaps(views.size());
  parallel_for_workers(static_cast<int>(views.size()), progress, [&] {
    return [&, step = ViewStep(work)](int i) mutable {
      if (!progress.finish_requested()) gaps[i] = step.improve(views[i], progress);
    };
  });
  return views.empty() ? 0 : *std::max_element(gaps.begin(), gaps.end());
}

LineCount& LineCount::operator+=(const LineCount& other) {
  violations += other.violations;
  lines += other.lines;
  return *this;
}

double LineCount::share() const {
  return lines > 0 ? static_cast<double>(violations) / static_cast<double>(lines) : 0;
}

LineCount count_lines(const ViewStack<float>& disparity, ViewIndex view, Image<float>& scratch) {
  LineCount count;
  const ImageView<const float> here = disparity.view(view);
  for (const ViewIndex way : kNeighbourWays) {
    if (!disparity.contains(neighbour(view, way))) continue;
    line_differences(here, here, disparity.view(neighbour(view, way)), step_along(way),
                     scratch.view());
    for (const float a : scratch) {
      count.lines += a == a ? 1 : 0;
      count.violations += a < kOrderingViolation ? 1 : 0;
    }
  }
  return count;
}

}  // namespace episcope
