// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/regularizer.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/labeling/device_labeling.h"
#include "engine/labeling/line_smoothing.h"
#include "engine/labeling/ray_vote.h"
#include "engine/labeling/solve_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>

namespace episcope {
namespace {

// In the order of lists.
constexpr RegularizerInfo kRegularizers[] = {
    {.choice = {Regularizer::None, "none"},
     .label_all = most_probable_labels_of_all,
     .label_one = most_probable_labels_of_view},
    {.choice = {Regularizer::View, "view"}, .label_all = smooth_views, .label_one = smooth_view},
    {.choice = {Regularizer::Rayspace, "rayspace"},
     .joins_views = true,
     .label_all = smooth_rays,
     .label_one = smooth_rays_of_view},
    {.choice = {Regularizer::Wsg13, "wsg13"},
     .joins_views = true,
     .label_all = smooth_lines,
     .label_one = smooth_lines_of_view},
};

bool covers(const GridShape& grid, ViewIndex first, const LabelProbabilities& p) {
  const ViewIndex begin{p.first.v - first.v, p.first.u - first.u};
  return grid.contains(begin) && grid.contains({begin.v + p.grid.v - 1, begin.u + p.grid.u - 1});
}

template <class T>
void check_maps(const ViewStack<T>& maps, const LabelProbabilities& p, const char* what) {
  const ProbabilityMap& view = p.views[0];
  if (maps.height() == view.height() && maps.width() == view.width() &&
      covers(maps.grid(), maps.first(), p)) {
    return;
  }
  throw InvalidInput(
      fmt::format("labels of {} views of {}×{} px need {} of the same size in each of these views",
                  p.grid.count(), view.width(), view.height(), what));
}

void check_samples(const RayLabelingInput& input) {
  const LightField* const lf = input.light_field;
  const LabelProbabilities& p = *input.probabilities;
  if (lf == nullptr || (lf->height() == p.views[0].height() && lf->width() == p.views[0].width() &&
                        covers(lf->grid(), {0, 0}, p))) {
    return;
  }
  throw InvalidInput("labels that are consistent along rays need their light field");
}

void check_joint_input(const RayLabelingInput& input) {
  if (input.disparity == nullptr || input.disparity->empty()) {
    throw InvalidInput(
        "labels that are consistent along rays need a disparity map of every view; estimate one "
        "first, or regularize each view alone");
  }
  check_maps(input.disparity->disparity, *input.probabilities, "disparities");
  check_samples(input);
}

void check_input(const RayLabelingInput& input, const RegularizerInfo& info,
                 const RayLabelingParameters& parameters) {
  if (input.probabilities == nullptr || input.probabilities->empty()) {
    throw InvalidInput("labels need probabilities of at least one view; train a classifier first");
  }
  if (info.joins_views) check_joint_input(input);
  if (input.edges != nullptr && !input.edges->empty()) {
    check_maps(*input.edges, *input.probabilities, "edges");
  }
  if (!(parameters.smoothness >= 0)) {
    throw InvalidInput("the smoothness of labels must not be negative");
  }
  if (!(parameters.floor > 0 && parameters.floor <= 1)) {
    throw InvalidInput("the minimum probability of a label must be above 0 and at most 1");
  }
}

}  // namespace

Names<Regularizer> names_of(Regularizer) {
  Names<Regularizer> names;
  for (const RegularizerInfo& info : kRegularizers) names.push_back(info.choice);
  return names;
}

const RegularizerInfo& info_of(Regularizer regularizer) {
  const auto* const found = std::ranges::find_if(
      kRegularizers, [=](const RegularizerInfo& info) { return info.choice.value == regularizer; });
  assert(found != std::end(kRegularizers));
  return *found;
}

RayLabeling label_rays(const RayLabelingInput& input, Regularizer regularizer,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  const RegularizerInfo& info = info_of(regularizer);
  check_input(input, info, parameters);
  return info.label_all(input, parameters, progress);
}

RayLabeling label_view(const RayLabelingInput& input, ViewIndex view, Regularizer regularizer,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  const RegularizerInfo& info = info_of(regularizer);
  check_input(input, info, parameters);
  if (!input.probabilities->contains(view)) {
    throw InvalidInput("there are no label probabilities of view " + view_text(view));
  }
  return info.label_one(input, view, parameters, progress);
}

namespace {

void label_into(const LabelProbabilities& p, ViewIndex view, RayLabeling& result) {
  const auto labels = most_probable_labels(p.view(view).view(), p.ids);
  std::copy(labels.begin(), labels.end(), result.labels.view(view).data);
}

}  // namespace

RayLabeling most_probable_labels_of_all(const RayLabelingInput& input, const RayLabelingParameters&,
                                        const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  RayLabeling result = unlabeled(p);
  parallel_for(p.grid.count(), progress, [&](int i) { label_into(p, p.view_at(i), result); });
  return result;
}

RayLabeling most_probable_labels_of_view(const RayLabelingInput& input, ViewIndex view,
                                         const RayLabelingParameters&, const Progress&) {
  RayLabeling result = unlabeled(*input.probabilities, view);
  label_into(*input.probabilities, view, result);
  return result;
}

namespace {

ViewProblems problems_of(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  const auto fill = [](ViewProblem& problem, ViewIndex view, const Progress&) {
    problem.fill_own(view);
  };
  return {input, parameters, {}, fill};
}

}  // namespace

RayLabeling smooth_views(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const Progress& progress) {
  if (is_for_device(input, parameters)) return label_on_device(input, parameters, {}, progress);
  RayLabeling result = solve_views(problems_of(input, parameters), progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_view(const RayLabelingInput& input, ViewIndex view,
                        const RayLabelingParameters& parameters, const Progress& progress) {
  RayLabeling result = solve_view(problems_of(input, parameters), view, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

namespace {

// Rounds of votes. The second makes labels agree that the first one has changed.
constexpr int kVotes = 2;

RayColors colors_of(const RayLabelingInput& input, const Progress& progress) {
  if (input.light_field == nullptr) return {};
  return {*input.light_field, input.probabilities->grid, input.probabilities->first, progress};
}

ViewProblems problems_of(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         TrackViews others, const Progress& progress) {
  const auto fill = [others](ViewProblem& problem, ViewIndex view, const Progress& part) {
    problem.fill_tracks(view, others, part);
  };
  return {input, parameters, colors_of(input, progress.part(0, 0)), fill};
}

void vote(const RayLabelingInput& input, const RayColors& colors, const Progress& progress,
          RayLabeling& result) {
  const RayVotes votes{static_cast<int>(input.probabilities->ids.size()), *input.disparity, colors};
  progress.step("rays");
  const ViewStack<std::int32_t> first =
      vote_along_rays(result.labels, votes, progress.part(0, 0.9));
  result.labels = vote_again_along_rays(result.labels, first, votes, progress.part(0.9, 1));
}

}  // namespace

RayLabeling smooth_rays(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                        const Progress& progress) {
  if (is_for_device(input, parameters)) {
    const RayColors colors = colors_of(input, progress.part(0, 0));
    return label_on_device(input, parameters, {&colors, kVotes}, progress);
  }
  const ViewProblems problems = problems_of(input, parameters, TrackViews::Near, progress);
  RayLabeling result = solve_views(problems, progress.part(0, 0.9));
  vote(input, problems.colors, progress.part(0.9, 1), result);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_rays_of_view(const RayLabelingInput& input, ViewIndex view,
                                const RayLabelingParameters& parameters, const Progress& progress) {
  const ViewProblems problems = problems_of(input, parameters, TrackViews::All, progress);
  RayLabeling result = solve_view(problems, view, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

}  // namespace episcope
