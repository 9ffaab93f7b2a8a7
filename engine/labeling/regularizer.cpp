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
#include <cstdlib>
#include <iterator>
#include <optional>
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

void check_input(const RayLabelingInput& input, bool joins_views,
                 const RayLabelingParameters& parameters) {
  if (input.probabilities == nullptr || input.probabilities->empty()) {
    throw InvalidInput("labels need probabilities of at least one view; train a classifier first");
  }
  if (joins_views) check_joint_input(input);
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

// One view that is wanted; empty = all that have probabilities.
using WantedView = std::optional<ViewIndex>;

// Without any coupling.
RayLabeling most_probable(const RayLabelingInput& input, WantedView view,
                          const RayLabelingParameters&, const Progress& progress) {
  const LabelProbabilities& p = *input.probabilities;
  RayLabeling result = view ? unlabeled(p, *view) : unlabeled(p);
  parallel_for(result.labels.grid().count(), progress, [&](int i) {
    const ViewIndex at = result.labels.view_at(i);
    const auto labels = most_probable_labels(p.view(at).view(), p.ids);
    std::copy(labels.begin(), labels.end(), result.labels.view(at).data);
  });
  return result;
}

// Boundaries within a view cost their length, weighted by edges (J_st of [WSG13]). Disparities
// speed it up: a view then starts from the result of its neighbor (solve_views). Energy and bound
// are sums over the views.
RayLabeling smooth_views(const RayLabelingInput& input, WantedView view,
                         const RayLabelingParameters& parameters, const Progress& progress) {
  if (!view && is_for_device(input, parameters)) {
    return label_on_device(input, parameters, {}, progress);
  }
  const ViewProblems problems{
      input, parameters, {}, [](ViewProblem& problem, ViewIndex of, const Progress&) {
        problem.fill_own(of);
      }};
  RayLabeling result =
      view ? solve_view(problems, *view, progress) : solve_views(problems, progress);
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

// Labels of all views that are consistent along the rays. The energy of [WSG13] has per-view TV
// weighted by edges (J_st), variation along the lines of horizontal and vertical EPIs (J_xs, J_yt)
// and one label per ray, relaxed to the simplex.
//
// It is minimized in two steps. Each view is solved alone
// (engine/solvers/simplex_labeling.h), the cost of a ray being the mean over the rays of
// the same scene point in the nearest 5×5 views, where their colors agree (`fill_track_costs`):
// errors of single rays average out. Then the rays of a scene point vote twice on their label
// along their EPIs, which makes labels constant along lines where the views had left
// them different.
//
// Why: a finite μ needs 8 floats per ray and label, 8 GB for 9×9×512×512 with 13 labels. The limit
// μ → ∞, one unknown per scene point, carried from five views to all others, is as quick but also
// carries labels along wrong disparities (tests/accuracy/tuning.md).
// Energy and bound are sums over the views as solved, before the vote.
// For one view, the cost of a ray is the mean over all views, and there is no vote.
RayLabeling smooth_rays(const RayLabelingInput& input, WantedView view,
                        const RayLabelingParameters& parameters, const Progress& progress) {
  if (!view && is_for_device(input, parameters)) {
    const RayColors colors = colors_of(input, progress.part(0, 0));
    return label_on_device(input, parameters, {&colors, kVotes}, progress);
  }
  const ViewProblems problems =
      problems_of(input, parameters, view ? TrackViews::All : TrackViews::Near, progress);
  RayLabeling result =
      view ? solve_view(problems, *view, progress) : solve_views(problems, progress.part(0, 0.9));
  if (!view) {
    vote_in_rounds({static_cast<int>(input.probabilities->ids.size()), *input.disparity,
                    problems.colors, &input},
                   nullptr, progress.part(0.9, 1), result.labels);
  }
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

// Labels of all views that minimize the energy of [WSG13] as a whole: the costs of all rays,
// −log p; boundaries within the views, weighted by edges (λ J_st); and μ times the weight of every
// line of a horizontal or vertical EPI on which the label changes from one view to the next
// (μ (J_xs + J_yt)), where the point is visible in both (`RayLines`). Relaxed to the simplex and
// solved with a bound for the whole (engine/solvers/linked_labeling.h), to
// `parameters.gap_joint`. Energy and bound belong to the joint problem.
//
// 16 bytes a ray and label and 46 a ray: 5.5 GB for 9×9×512×512 with 13 labels.
// One view is solved together with all others, to `parameters.gap`.
RayLabeling smooth_lines(const RayLabelingInput& input, WantedView view,
                         const RayLabelingParameters& parameters, const Progress& progress) {
  RayLabeling result =
      solve(input, parameters, view ? parameters.gap : parameters.gap_joint, progress);
  if (view) {
    ViewStack<std::int32_t> wanted = unlabeled(*input.probabilities, *view).labels;
    std::copy_n(result.labels.view(*view).data, wanted.size(), wanted.data());
    result.labels = std::move(wanted);
  }
  replace_layers_by_ids(input.probabilities->ids, result);
  return result;
}

struct RegularizerInfo {
  Named<Regularizer> choice;
  bool joins_views = false;
  RayLabeling (*label)(const RayLabelingInput&, WantedView, const RayLabelingParameters&,
                       const Progress&) = nullptr;
};

// In the order of lists.
constexpr RegularizerInfo kRegularizers[] = {
    {{Regularizer::None, "none"}, false, most_probable},
    {{Regularizer::View, "view"}, false, smooth_views},
    {{Regularizer::Rayspace, "rayspace"}, true, smooth_rays},
    {{Regularizer::Wsg13, "wsg13"}, true, smooth_lines},
};

const RegularizerInfo& info_of(Regularizer regularizer) {
  const auto* const found = std::ranges::find_if(
      kRegularizers, [=](const RegularizerInfo& info) { return info.choice.value == regularizer; });
  assert(found != std::end(kRegularizers));
  return *found;
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

Names<Regularizer> names_of(Regularizer) {
  Names<Regularizer> names;
  for (const RegularizerInfo& info : kRegularizers) names.push_back(info.choice);
  return names;
}

bool joins_views(Regularizer regularizer) {
  return info_of(regularizer).joins_views;
}

RayLabeling label_rays(const RayLabelingInput& input, Regularizer regularizer,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  const RegularizerInfo& info = info_of(regularizer);
  check_input(input, info.joins_views, parameters);
  return info.label(input, {}, parameters, progress);
}

RayLabeling label_view(const RayLabelingInput& input, ViewIndex view, Regularizer regularizer,
                       const RayLabelingParameters& parameters, const Progress& progress) {
  const RegularizerInfo& info = info_of(regularizer);
  check_input(input, info.joins_views, parameters);
  if (!input.probabilities->contains(view)) {
    throw InvalidInput("there are no label probabilities of view " + view_text(view));
  }
  return info.label(input, view, parameters, progress);
}

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

}  // namespace episcope
