// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/ray_space.h"

#include "engine/core/parallel.h"
#include "engine/labeling/boundary_weights.h"
#include "engine/labeling/ray_targets.h"
#include "engine/labeling/view_problem.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace episcope {
namespace {

constexpr std::int32_t kUnknown = -1;
// Views whose own problem is solved, and the share of unknown rays worth another one.
constexpr int kMostReferences = 5;
constexpr double kWorthSolving = 5e-4;
constexpr int kSettlingSweeps = 3;

bool differs_nearby(ImageView<const std::int32_t> labels, PixelIndex at) {
  const std::int32_t label = labels.at(at.y, at.x);
  return (at.x > 0 && labels.at(at.y, at.x - 1) != label) ||
         (at.x + 1 < labels.width && labels.at(at.y, at.x + 1) != label) ||
         (at.y > 0 && labels.at(at.y - 1, at.x) != label) ||
         (at.y + 1 < labels.height && labels.at(at.y + 1, at.x) != label);
}

class RaySpace {
 public:
  RaySpace(const RayLabelingInput& input, const RayLabelingParameters& parameters,
           RayLabeling& result)
      : input_(input),
        parameters_(parameters),
        result_(result),
        labels_(result.labels),
        problem_(input, parameters),
        unknown_(static_cast<std::size_t>(labels_.grid().count()),
                 static_cast<std::int64_t>(labels_.view_size())) {
    std::fill_n(labels_.data(), labels_.size(), kUnknown);
  }

  void run(const Progress& progress);

 private:
  void solve(ViewIndex reference, const Progress& progress);
  void carry(ViewIndex reference, const Progress& progress);
  void carry_to(ViewIndex reference, int i, const Progress& progress);
  // What one view is settled by.
  struct Settling {
    VolumeView<const float> costs;
    ImageView<const float> weights;
    ImageView<std::int32_t> labels;
  };
  void settle(int i, Volume<float>& costs, const Progress& progress);
  void settle_pixel(const Settling& at_hand, PixelIndex at) const;

  const RayLabelingInput& input_;
  const RayLabelingParameters& parameters_;
  RayLabeling& result_;
  ViewStack<std::int32_t>& labels_;
  ViewProblem problem_;
  std::vector<std::int64_t> unknown_;  // rays of each view
  bool is_first_ = true;
};

void RaySpace::solve(ViewIndex reference, const Progress& progress) {
  const auto labels = labels_.view(reference);
  problem_.fill_tracks(reference, is_first_ ? ImageView<std::int32_t>{} : labels,
                       progress.part(0, 0.2));
  const SimplexResult part = problem_.solve(reference, progress.part(0.2, 1), labels);
  result_.energy += part.energy;
  result_.bound += part.bound;
  result_.iterations = std::max(result_.iterations, part.iterations);
  is_first_ = false;
}

void RaySpace::carry_to(ViewIndex reference, int i, const Progress& progress) {
  const ViewIndex view = labels_.view_at(i);
  unknown_[i] = 0;
  if (view == reference) return;
  const auto to = labels_.view(view);
  const auto from = labels_.view(reference);
  std::vector<std::int32_t> targets(labels_.width());
  for (int y = 0; y < to.height; ++y) {
    progress.check();
    find_ray_targets(input_.disparity->view(view), input_.disparity->view(reference),
                     {reference.v - view.v, reference.u - view.u}, y, targets.data());
    std::int32_t* const row = to.row(y);
    for (int x = 0; x < to.width; ++x) {
      if (row[x] == kUnknown && targets[x] >= 0) row[x] = from.data[targets[x]];
      unknown_[i] += row[x] == kUnknown ? 1 : 0;
    }
  }
}

void RaySpace::carry(ViewIndex reference, const Progress& progress) {
  parallel_for(labels_.grid().count(), progress, [&](int i) { carry_to(reference, i, progress); });
}

// The cheapest of a pixel's own label and those of its neighbours; of all labels if it has none.
void RaySpace::settle_pixel(const Settling& at_hand, PixelIndex at) const {
  const auto& [costs, weights, labels] = at_hand;
  const PixelIndex neighbours[] = {
      {at.y, at.x - 1}, {at.y, at.x + 1}, {at.y - 1, at.x}, {at.y + 1, at.x}};
  const std::int32_t former = labels.at(at.y, at.x);
  float least = 0;
  std::int32_t best = kUnknown;
  for (int layer = 0; layer < costs.layers; ++layer) {
    float cost = costs.at(at.y, layer, at.x);
    bool is_near = former == kUnknown || former == layer;
    for (const PixelIndex n : neighbours) {
      if (n.y < 0 || n.x < 0 || n.y >= costs.height || n.x >= costs.width) continue;
      const std::int32_t label = labels.at(n.y, n.x);
      is_near = is_near || label == layer;
      if (label == kUnknown || label == layer) continue;
      const PixelIndex first{std::min(n.y, at.y), std::min(n.x, at.x)};
      const float g = weights.empty() ? 1.0F : weights.at(first.y, first.x);
      cost += static_cast<float>(parameters_.smoothness) * g;
    }
    if (!is_near || (best != kUnknown && cost >= least)) continue;
    least = cost;
    best = layer;
  }
  labels.at(at.y, at.x) = best;
}

// Rays that no reference sees, and those at boundaries, which were carried to the nearest pixel: by
// the costs of their tracks, the view's own edges and their neighbours' labels.
void RaySpace::settle(int i, Volume<float>& costs, const Progress& progress) {
  const ViewIndex view = labels_.view_at(i);
  const auto labels = labels_.view(view);
  Image<std::int32_t> fixed(labels.height, labels.width);
  std::vector<PixelIndex> open;
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const std::int32_t label = labels.at(y, x);
      const bool is_open = label == kUnknown || differs_nearby(labels, {y, x});
      fixed.at(y, x) = is_open ? kUnknown : label;
      if (is_open) open.push_back({y, x});
    }
  }
  if (open.empty()) return;
  fill_track_costs({*input_.probabilities, *input_.disparity, view, fixed}, problem_.table(),
                   progress.part(0, 0).on_one_thread(), costs.view());
  const Image<float> weights = problem_.weights(view);
  const Settling at_hand{costs.view(), weights, labels};
  for (int sweep = 0; sweep < kSettlingSweeps; ++sweep) {
    progress.check();
    for (const PixelIndex at : open) settle_pixel(at_hand, at);
    std::reverse(open.begin(), open.end());
  }
}

void RaySpace::run(const Progress& progress) {
  ViewIndex reference{labels_.first().v + labels_.grid().center().v,
                      labels_.first().u + labels_.grid().center().u};
  const ViewIndex middle = reference;  // settled by its own problem
  int references = 0;
  std::string used;
  while (true) {
    progress.step("rays of view " + view_text(reference));
    const double begin = references == 0 ? 0 : 0.5 + 0.1 * (references - 1);
    const double end = 0.5 + 0.1 * references;
    ++references;
    solve(reference, progress.part(begin, end - 0.02));
    carry(reference, progress.part(end - 0.02, end));
    used += (used.empty() ? "" : "; ") + view_text(reference);
    const auto most = std::max_element(unknown_.begin(), unknown_.end());
    if (static_cast<double>(*most) <= kWorthSolving * static_cast<double>(labels_.view_size())) {
      break;
    }
    if (references == kMostReferences) break;
    reference = labels_.view_at(static_cast<int>(most - unknown_.begin()));
  }
  std::int64_t left = 0;
  for (const std::int64_t count : unknown_) left += count;
  progress.step("boundaries");
  const ProbabilityMap& like = input_.probabilities->views[0];
  parallel_for_workers(labels_.grid().count(), progress.part(0.92, 1), [&] {
    auto costs = std::make_shared<Volume<float>>(like.height(), like.layers(), like.width());
    return [this, costs, &progress, middle](int i) {
      if (!(labels_.view_at(i) == middle)) settle(i, *costs, progress);
    };
  });
  char text[160];
  std::snprintf(text, sizeof text,
                "Rays are labeled where the views %s see them; %.3f %% of all rays by themselves.",
                used.c_str(),
                100.0 * static_cast<double>(left) / static_cast<double>(labels_.size()));
  result_.notes.emplace_back(text);
}

}  // namespace

void label_ray_space(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                     const Progress& progress, RayLabeling& result) {
  RaySpace(input, parameters, result).run(progress);
}

}  // namespace episcope
