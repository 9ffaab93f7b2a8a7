// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/regularizer.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/core/scene.h"
#include "engine/labeling/solve_views.h"
#include "engine/solvers/linked_labeling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace episcope {

namespace {

void keep_painted(const RayLabelingInput* input, ViewStack<std::int32_t>& layers) {
  if (input == nullptr || input->strokes == nullptr) return;
  for (const ViewScribbles& each : input->strokes->views) {
    if (!layers.contains(each.view)) continue;
    keep_painted(painted_layers(*input, each.view), layers.view(each.view));
  }
}

using LinesOfView = std::array<RayLines, kLinkKinds>;

// The next view to the right and below.
constexpr ViewIndex kSteps[kLinkKinds] = {{0, 1}, {1, 0}};

std::vector<LinesOfView> lines_of(const RayLabelingInput& input, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  const RayColors colors = input.light_field == nullptr ? RayColors()
                                                        : RayColors(*input.light_field, p.grid,
                                                                    p.first, progress.part(0, 0));
  const ViewIndex middle{p.first.v + p.grid.v / 2, p.first.u + p.grid.u / 2};
  std::vector<LinesOfView> lines(p.views.size());
  parallel_for(p.grid.count(), progress, [&](int i) {
    const ViewIndex view = p.view_at(i);
    for (int kind = 0; kind < kLinkKinds; ++kind) {
      const ViewIndex next{view.v + kSteps[kind].v, view.u + kSteps[kind].u};
      if (!p.contains(next)) continue;
      lines[i][kind] = find_ray_lines({*input.disparity, colors, middle}, view, next, progress);
    }
  });
  return lines;
}

// The problem, and what it borrows.
struct JointProblem {
  JointProblem(const RayLabelingInput& input, const RayLabelingParameters& parameters,
               const Progress& progress)
      : lines(lines_of(input, progress.part(0, 0.7))),
        weights(boundary_weights_of(input, progress.part(0.7, 1))) {
    state(input, parameters);
  }
  JointProblem(const JointProblem&) = delete;
  JointProblem& operator=(const JointProblem&) = delete;

  std::vector<LinesOfView> lines;
  std::vector<Image<float>> weights;
  std::vector<ProbabilityMap> held;  // With strokes.
  LinkedProblem problem;

 private:
  void state(const RayLabelingInput& input, const RayLabelingParameters& parameters);
};

// Probabilities of a view whose least code, 0, only painted pixels have, of other labels.
ProbabilityMap with_held(const RayLabelingInput& input, ViewIndex view) {
  const ProbabilityMap& own = input.probabilities->view(view);
  ProbabilityMap held(own.height(), own.layers(), own.width());
  const auto map = own.view();
  std::transform(map.data, map.data + map.size(), held.view().data,
                 [](std::uint8_t code) { return std::max(code, std::uint8_t{1}); });
  const Image<std::int32_t> painted = painted_layers(input, view);
  for (int y = 0; y < painted.height(); ++y) {
    for (int x = 0; x < painted.width(); ++x) {
      if (painted.at(y, x) < 0) continue;
      for (int l = 0; l < held.layers(); ++l) {
        held.view().at(y, l, x) = l == painted.at(y, x) ? 255 : 0;
      }
    }
  }
  return held;
}

void JointProblem::state(const RayLabelingInput& input, const RayLabelingParameters& parameters) {
  const LabelProbabilities& p = *input.probabilities;
  problem.table = cost_table(parameters.floor);
  problem.smoothness = parameters.smoothness;
  problem.coherence = parameters.coherence;
  if (input.strokes != nullptr && !input.strokes->views.empty()) {
    problem.table[0] = price_of_held(parameters.smoothness + parameters.coherence);
    for (int i = 0; i < p.grid.count(); ++i) held.push_back(with_held(input, p.view_at(i)));
  }
  for (int i = 0; i < p.grid.count(); ++i) {
    LinkedImage& image = problem.images.emplace_back();
    image.codes = (held.empty() ? p.views : held)[i].view();
    if (!weights[i].empty()) image.g = weights[i];
    for (int kind = 0; kind < kLinkKinds; ++kind) {
      const RayLines& of_kind = lines[i][kind];
      if (of_kind.target.empty()) continue;
      const int to = i + kSteps[kind].v * p.grid.u + kSteps[kind].u;
      image.links[kind] = {to, of_kind.target, of_kind.weight};
    }
  }
}

// Layers, not ids.
RayLabeling solve(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                  double gap, const Progress& progress) {
  progress.step("lines");
  const JointProblem joint(input, parameters, progress.part(0, 0.03));
  LinkedOptions options;
  options.gap = gap;
  options.max_iterations = parameters.max_iterations;
  RayLabeling result = unlabeled(*input.probabilities);
  std::vector<ImageView<int>> labels;
  for (int i = 0; i < input.probabilities->grid.count(); ++i) {
    labels.push_back(result.labels.view(input.probabilities->view_at(i)));
  }
  progress.step("views");
  const LinkedResult solved =
      solve_linked_labeling(joint.problem, options, progress.part(0.03, 1), labels);
  result.energy = solved.energy;
  result.bound = solved.bound;
  result.iterations = solved.iterations;
  keep_painted(&input, result.labels);
  return result;
}

}  // namespace

RayLabeling smooth_lines(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                         const Progress& progress) {
  RayLabeling result = solve(input, parameters, parameters.gap_joint, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

RayLabeling smooth_lines_of_view(const RayLabelingInput& input, ViewIndex view,
                                 const RayLabelingParameters& parameters,
                                 const Progress& progress) {
  const RayLabeling all = solve(input, parameters, parameters.gap, progress);
  RayLabeling result = unlabeled(*input.probabilities, view);
  result.energy = all.energy;
  result.bound = all.bound;
  result.iterations = all.iterations;
  const ImageView<const std::int32_t> wanted = all.labels.view(view);
  std::copy_n(wanted.data, all.labels.view_size(), result.labels.view(view).data);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

double line_energy(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                   const ViewStack<std::int32_t>& labels) {
  const LabelProbabilities& p = *input.probabilities;
  ViewStack<std::int32_t> layers = labels.clone();
  std::for_each(layers.data(), layers.data() + layers.size(), [&p](std::int32_t& label) {
    label = static_cast<std::int32_t>(std::ranges::lower_bound(p.ids, label) - p.ids.begin());
  });
  std::vector<ImageView<const int>> views;
  for (int i = 0; i < p.grid.count(); ++i) {
    views.push_back(std::as_const(layers).view(p.view_at(i)));
  }
  return linked_energy(JointProblem(input, parameters, Progress()).problem, views);
}

namespace {

// Place in the next view of a ray at `from`, on the line of slope d through the pixel center that
// is nearest to it in the middle view, `steps` before this one.
float drawn_on(int from, float d, int steps) {
  const float center = std::floor(static_cast<float>(from) + d * static_cast<float>(steps) + 0.5F);
  return std::floor(center - d * static_cast<float>(steps + 1) + 0.5F);
}

// Two views and the way from one to the other.
struct Step {
  DisparityView here, there;
  bool is_across = false;
  int from_middle = 0;  // views between the middle column (row) and the first view
};

// Where the line through a pixel ends in the other view, −1 if it does not get there.
std::int32_t line_end(const Step& step, int y, int x) {
  const auto& [here, there, is_across, from_middle] = step;
  if (!here.is_valid(y, x)) return -1;
  const int width = here.disparity.width, height = here.disparity.height;
  const float d = here.disparity.at(y, x);
  const float at_x = is_across ? drawn_on(x, d, from_middle) : static_cast<float>(x);
  const float at_y = is_across ? static_cast<float>(y) : drawn_on(y, d, from_middle);
  // The comparison also drops what is too far off to be an int.
  if (!(at_x >= 0 && at_y >= 0 && at_x < static_cast<float>(width) &&
        at_y < static_cast<float>(height))) {
    return -1;
  }
  const PixelIndex end{static_cast<int>(at_y), static_cast<int>(at_x)};
  if (!there.is_valid(end.y, end.x)) return -1;
  const bool is_hidden = std::fabs(there.disparity.at(end.y, end.x) - d) > kSamePointTolerance_px;
  return is_hidden ? -1 : end.y * width + end.x;
}

}  // namespace

RayLines find_ray_lines(const RayLineSources& sources, ViewIndex view, ViewIndex next,
                        const Progress& progress) {
  const bool is_across = next.u != view.u;
  const Step step{sources.disparity.view(view), sources.disparity.view(next), is_across,
                  is_across ? view.u - sources.middle.u : view.v - sources.middle.v};
  const int height = step.here.disparity.height, width = step.here.disparity.width;
  RayLines lines{Image<std::int32_t>(height, width), Image<std::uint8_t>(height, width)};
  std::fill(lines.target.begin(), lines.target.end(), -1);
  std::fill(lines.weight.begin(), lines.weight.end(), std::uint8_t{0});
  std::vector<bool> is_taken(static_cast<std::size_t>(height) * width);
  for (int y = 0; y < height; ++y) {
    progress.check();
    const RayColors::Pair colors = sources.colors.pair(view, y, next);
    for (int x = 0; x < width; ++x) {
      const std::int32_t end = line_end(step, y, x);
      if (end < 0 || is_taken[end]) continue;
      const auto weight =
          static_cast<std::uint8_t>(255 * sources.colors.trust(colors, x, end) + 0.5F);
      if (weight == 0) continue;
      lines.target.at(y, x) = end;
      lines.weight.at(y, x) = weight;
      is_taken[end] = true;
    }
  }
  return lines;
}

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

// Rounds of votes. The second makes labels agree that the first one has changed.
constexpr int kVotes = 2;

}  // namespace

void vote_in_rounds(const RayVotes& votes, const ViewStack<std::int32_t>* before,
                    const Progress& progress, ViewStack<std::int32_t>& labels) {
  progress.step("rays");
  const Progress first = progress.part(0, 0.9), others = progress.part(0.9, 1);
  ViewStack<std::int32_t> voted = before ? vote_again_along_rays(*before, labels, votes, first)
                                         : vote_along_rays(labels, votes, first);
  keep_painted(votes.input, voted);
  for (int round = 1; round < kVotes; ++round) {
    ViewStack<std::int32_t> next = vote_again_along_rays(labels, voted, votes, others);
    keep_painted(votes.input, next);
    labels = std::move(voted);
    voted = std::move(next);
  }
  labels = std::move(voted);
}

RayLabeling smooth_rays(const RayLabelingInput& input, const RayLabelingParameters& parameters,
                        const Progress& progress) {
  if (is_for_device(input, parameters)) {
    const RayColors colors = colors_of(input, progress.part(0, 0));
    return label_on_device(input, parameters, {&colors, kVotes}, progress);
  }
  const ViewProblems problems = problems_of(input, parameters, TrackViews::Near, progress);
  RayLabeling result = solve_views(problems, progress.part(0, 0.9));
  vote_in_rounds({static_cast<int>(input.probabilities->ids.size()), *input.disparity,
                  problems.colors, &input},
                 nullptr, progress.part(0.9, 1), result.labels);
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
