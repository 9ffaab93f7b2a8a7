// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/labeler.h"

#include "engine/core/error.h"
#include "engine/core/parallel.h"
#include "engine/cuda/device.h"
#include "engine/labeling/correct_views.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/predict_from_strokes.h"
#include "engine/labeling/reweight_by_color.h"
#include "engine/labeling/solve_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace episcope {
namespace {

// Throws InvalidInput unless the views are in the grid, and one at least.
void require_views(ViewRectangle views, GridShape grid) {
  const ViewIndex last{views.first.v + views.grid.v - 1, views.first.u + views.grid.u - 1};
  if (views.grid.v > 0 && views.grid.u > 0 && grid.contains(views.first) && grid.contains(last)) {
    return;
  }
  throw InvalidInput(
      fmt::format("views {} to {} were requested, but there are {}×{} views, counted from 0",
                  view_text(views.first), view_text(last), grid.v, grid.u));
}

// Throws InvalidInput if the regularizer joins views and there is no disparity to join them by.
void require_disparity(Regularizer regularizer, bool has_disparity) {
  if (has_disparity || !joins_views(regularizer)) return;
  throw InvalidInput(
      "labels that are consistent along rays need the disparity of all views; estimate it first, "
      "or smooth each view alone");
}

// The view and those beside it in its row; in a grid of one column, above and below.
ViewRectangle adjacent_views(ViewIndex view, GridShape grid) {
  const int down = grid.u > 1 ? 0 : 1;
  const int across = 1 - down;
  const ViewIndex first{std::max(view.v - down, 0), std::max(view.u - across, 0)};
  const ViewIndex last{std::min(view.v + down, grid.v - 1), std::min(view.u + across, grid.u - 1)};
  return {first, {last.v - first.v + 1, last.u - first.u + 1}};
}

using Features = std::shared_ptr<const PixelFeatures>;

// Up to this many requested views are processed one after the other, each by all threads, and their
// features are kept: the user is painting. More are processed in parallel.
constexpr std::size_t kKeptViews = 9;

// So many trees vote for a draft while painting; the others are grown after it.
constexpr int kDraftTrees = 32;

// Solvers of the view that is painted are kept if they take no more.
constexpr double kKeptSolverBytes = double{1 << 30};

// For a single view: half the iterations give the same accuracy.
constexpr double kLiveGap = 5e-3;

ForestOptions forest_options(const LabelerParameters& parameters) {
  ForestOptions options;
  options.trees = parameters.trees;
  options.depth = parameters.depth;
  options.seed = parameters.seed;
  return options;
}

bool covers(const ViewStack<float>& maps, ViewRectangle views) {
  const int last = views.grid.count() - 1;
  return maps.contains(views.first) && maps.contains(views.grid.view_at(last, views.first));
}

/// What was learned from strokes; borrows it.
struct Learned {
  const Scribbles& scribbles;
  const std::vector<std::int32_t>& ids;
  const LabelerParameters& parameters;
  const Forest& forest;
};

// Whether the set of features includes disparity.
bool uses_disparity(const LabelerParameters& parameters) {
  return parameters.features != FeatureSet::Image;
}

}  // namespace

struct Labeler::State {
  LightFieldPtr light_field;
  std::shared_ptr<const DisparityField> disparity;
  std::shared_ptr<const ViewStack<float>> edges;
  std::shared_ptr<const ViewStack<float>> confidence;
  bool has_own_edges = false;  // Computed here, with or without disparity as `set` says.
  PixelFeatureSet set;
  Device asked = Device::Auto;
  Device used = Device::Cpu;  // In the call at hand.
  std::string note;
  std::deque<std::pair<ViewIndex, Features>> kept;  // The newest last.
  GrownForest grown;
  bool is_painting = false, keeps_solvers = false;  // In the call at hand.
  KeptSolver reference_solver, own_solver;  // Of the view being painted: for `judge`, and after it.

  /// What strokes say of one view, before colors judge it.
  struct Said {
    ViewIndex view;
    std::vector<ViewScribbles> strokes;
    ParameterSet parameters;
    std::vector<std::int32_t> ids;
    ProbabilityMap map;
  };
  std::optional<Said> said;         // The newest, by `say`.
  std::optional<RayColors> colors;  // Of all views, by `find_colors`.

  /// Probabilities of one view by all trees, kept until the next call.
  const Said& say(const Scribbles& scribbles, const LabelerParameters& parameters, ViewIndex view,
                  const Progress& progress) {
    const ParameterSet values = labeler_schema().values(parameters);
    if (said && said->view == view && said->parameters == values &&
        have_same_strokes(said->strokes, scribbles.views)) {
      return *said;
    }
    Said now{view, scribbles.views, values, painted_labels(scribbles, *light_field), {}};
    begin(false, now.ids);
    const Learned learned = learn(scribbles, now.ids, parameters, progress.part(0, 0.5));
    LabelProbabilities one = empty_probabilities(now.ids, {view, {1, 1}});
    predict(learned, one, progress.part(0.5, 1));
    now.map = std::move(one.views[0]);
    said = std::move(now);
    return *said;
  }

  [[nodiscard]] bool can_correct(const LabelerParameters& parameters,
                                 const Labeling& before) const {
    const GridShape grid = light_field->grid();
    return parameters.regularizer == Regularizer::Rayspace && disparity &&
           disparity->disparity.grid() == grid && before.labels.grid() == grid &&
           before.probabilities.views.size() == static_cast<std::size_t>(grid.count());
  }

  /// What strokes in one view say that is new.
  struct SaidNews {
    ViewIndex view;
    Image<std::uint8_t> news;
    ProbabilityMap after;
  };

  /// What is corrected: probabilities and which of them are new, in views that were brought.
  struct Corrected {
    const Scribbles& strokes;
    LabelProbabilities probabilities;
    ChangedRays changed;
    std::vector<SaidNews> news;
  };

  void find_colors(const Progress& progress) {
    if (!colors) colors.emplace(*light_field, light_field->grid(), ViewIndex{0, 0}, progress);
  }

  /// Takes over the probabilities of these views, unless that was done, with all news.
  void bring(const Labeling& before, const std::vector<ViewIndex>& views, const Progress& progress,
             Corrected& into) const {
    parallel_for(static_cast<int>(views.size()), progress, [&](int i) {
      const ViewIndex view = views[static_cast<std::size_t>(i)];
      ProbabilityMap& own = into.probabilities.view(view);
      if (!own.empty()) return;
      own = with_layers(before.probabilities.view(view).view(), before.probabilities.ids,
                        into.probabilities.ids);
      for (const SaidNews& each : into.news) {
        carry_news({each.view, each.news, each.after.view()}, *disparity, *colors, view,
                   into.probabilities, into.changed);
      }
    });
  }

  [[nodiscard]] std::vector<SaidNews> find_news(const Scribbles& scribbles,
                                                const std::vector<std::int32_t>& ids,
                                                const LabelerParameters& parameters,
                                                const LabelCorrection& correction,
                                                const Progress& progress) {
    std::vector<SaidNews> all;
    for (const auto& [view, strokes] :
         new_strokes(correction.former, scribbles, correction.first)) {
      const Said& former = say(correction.former, parameters, view, progress.part(0, 0.5));
      const ProbabilityMap before = with_layers(former.map.view(), former.ids, ids);
      const Said& now = say(scribbles, parameters, view, progress.part(0.5, 1));
      ProbabilityMap after = with_layers(now.map.view(), ids, ids);
      Image<std::uint8_t> news = news_of(before.view(), after.view(), strokes);
      if (!set.with_disparity || confidence) {
        reweight_view_by_color(*light_field, view,
                               layers_after(correction.before.labels.view(view), news, after, ids),
                               progress.part(1, 1), after);
      }
      all.push_back({view, std::move(news), std::move(after)});
    }
    return all;
  }

  [[nodiscard]] RayLabeling solve_news(const LabelerParameters& parameters,
                                       const LabelCorrection& correction, const Progress& progress,
                                       Corrected& corrected) {
    const ViewRectangle everything{{0, 0}, light_field->grid()};
    find_edges(everything, progress.part(0, 0.2));
    find_colors(progress.part(0.2, 0.2));
    std::vector<ViewIndex> near = near_views(everything, correction.first);
    near.push_back(correction.first);
    bring(correction.before, near, progress.part(0.2, 0.25), corrected);
    const RayLabelingInput input = input_of(&corrected.probabilities, &corrected.strokes);
    RayCorrection rays{correction.before.labels, corrected.changed, correction.first, *colors};
    rays.complete = [&](const Progress& part) {
      std::vector<ViewIndex> all;
      for (int i = 0; i < everything.grid.count(); ++i) all.push_back(everything.grid.view_at(i));
      bring(correction.before, all, part, corrected);
    };
    if (correction.on_view) {
      rays.on_view = [&](ViewIndex view, ImageView<const std::int32_t> layers) {
        Image<std::int32_t> labels(layers.height, layers.width);
        std::transform(layers.data, layers.data + layers.size(), labels.begin(),
                       [&](std::int32_t layer) {
                         return corrected.probabilities.ids[static_cast<std::size_t>(layer)];
                       });
        clear_invalid(view, labels.view());
        correction.on_view(view, std::move(labels));
      };
    }
    return correct_rays(input, options_of(parameters), rays, progress.part(0.25, 1));
  }

  void use(PixelFeatureSet wanted) {
    if (wanted.with_disparity == set.with_disparity) return;
    set = wanted;
    kept.clear();
    if (has_own_edges) edges = nullptr;
  }

  void drop_solvers() {
    reference_solver.drop();
    own_solver.drop();
  }

  void forget_views() {
    kept.clear();
    colors.reset();
    drop_solvers();
  }

  void begin(bool painting, const std::vector<std::int32_t>& ids) {
    is_painting = painting;
    const double pixels = static_cast<double>(light_field->height()) * light_field->width();
    const bool fit =
        2 * KeptSolver::bytes(pixels, static_cast<int>(ids.size())) <= kKeptSolverBytes;
    keeps_solvers = is_painting && fit;
    if (!fit) drop_solvers();
  }

  void choose_device(int views) {
    const bool are_many = views > static_cast<int>(kKeptViews);
    const bool can = asked == Device::Cuda || (asked == Device::Auto && has_cuda_device());
    used = are_many && can ? Device::Cuda : Device::Cpu;
    note = used == Device::Cuda ? "computed on " + known_cuda_device().name : "";
  }

  /// Does `work` on the device chosen, or on the CPU if that fails and was not demanded.
  void compute(const std::function<void()>& work) {
    try {
      work();
    } catch (const DeviceFailure& failure) {
      if (asked == Device::Cuda || used == Device::Cpu) throw;
      used = Device::Cpu;
      note = fmt::format("computed on the CPU: {}", failure.what());
      work();
    }
  }

  [[nodiscard]] Features find_features(ViewIndex view) const {
    const auto found = std::ranges::find(kept, view, &std::pair<ViewIndex, Features>::first);
    return found == kept.end() ? nullptr : found->second;
  }

  [[nodiscard]] Features compute_features(ViewIndex view, const Progress& progress) const {
    const DisparityView own =
        disparity && disparity->contains(view) ? disparity->view(view) : DisparityView{};
    return std::make_shared<const PixelFeatures>(
        compute_pixel_features(*light_field, view, own, set, progress));
  }

  /// Features of a view, kept from now on in place of the oldest ones.
  [[nodiscard]] Features keep_features(ViewIndex view, const Progress& progress) {
    if (Features found = find_features(view)) return found;
    Features computed = compute_features(view, progress);
    const std::size_t each = computed->view().size() * sizeof(float);
    while (!kept.empty() && (kept.size() + 1) * each > kKeptBytes) kept.pop_front();
    kept.emplace_back(view, computed);
    return computed;
  }

  [[nodiscard]] ForestSamples samples_of(const Scribbles& scribbles,
                                         const std::vector<std::int32_t>& ids,
                                         const Progress& progress) {
    ForestSamples samples;
    samples.label_count = static_cast<int>(ids.size());
    for (const ViewScribbles* painted : teaching_views(scribbles.views)) {
      progress.check();
      const Features of_view = keep_features(painted->view, progress.part(0, 0));
      samples.feature_count = of_view->layers();
      append_samples(*painted, of_view->view(), ids, samples);
    }
    return samples;
  }

  /// The forest of these strokes: for a draft, while they are painted, a part of it at least.
  [[nodiscard]] Learned learn(const Scribbles& scribbles, const std::vector<std::int32_t>& ids,
                              const LabelerParameters& parameters, const Progress& progress) {
    const Forest& forest =
        grown.train(samples_of(scribbles, ids, progress.part(0, 0)), forest_options(parameters),
                    is_painting ? kDraftTrees : parameters.trees, progress);
    if (!is_painting) grown.complete(progress.part(1, 1));
    return {scribbles, ids, parameters, forest};
  }

  [[nodiscard]] ProbabilityMap predict_one(const Learned& learned, ViewIndex view,
                                           const PixelFeatures& features, const PixelVotes& votes,
                                           const Progress& progress) const {
    const StrokeKnowledge known{learned.scribbles, learned.ids,      learned.parameters.nearness,
                                disparity.get(),   confidence.get(), set.with_disparity};
    return predict_from_strokes(known, view, features.view(), votes, progress);
  }

  /// Probabilities of the views of `into` that have none yet.
  void predict(const Learned& learned, LabelProbabilities& into, const Progress& progress) {
    std::vector<ViewIndex> missing;
    for (int i = 0; i < into.grid.count(); ++i) {
      if (into.views[static_cast<std::size_t>(i)].empty()) missing.push_back(into.view_at(i));
    }
    if (missing.size() <= kKeptViews) {
      predict_few(learned, missing, into, progress);
    } else {
      predict_many(learned, missing, into, progress);
    }
  }

  /// By all trees, where some were missing.
  void complete(const Learned& learned, LabelProbabilities& own, const Progress& progress) {
    if (!grown.complete(progress)) return;
    own = empty_probabilities(own.ids, {own.first, own.grid});
    predict(learned, own, progress);
  }

  void predict_few(const Learned& learned, const std::vector<ViewIndex>& views,
                   LabelProbabilities& into, const Progress& progress) {
    std::vector<Features> features;
    for (const ViewIndex view : views) features.push_back(keep_features(view, progress.part(0, 0)));
    const auto predict_with = [&](int i, const Progress& part) {
      const PixelFeatures& of_view = *features[static_cast<std::size_t>(i)];
      const ViewIndex view = views[static_cast<std::size_t>(i)];
      into.view(view) =
          predict_one(learned, view, of_view, {learned.forest, of_view.view(), part}, part);
    };
    const int count = static_cast<int>(views.size());
    // A part of the work on a view is done by one thread.
    if (progress.threads() <= count) {
      const Progress alone = progress.part(0, 0).on_one_thread();
      parallel_for(count, progress, [&](int i) { predict_with(i, alone); });
    } else {
      for (int i = 0; i < count; ++i) predict_with(i, progress.part(0, 0));
    }
  }

  void predict_many(const Learned& learned, const std::vector<ViewIndex>& views,
                    LabelProbabilities& into, const Progress& progress) {
    const std::shared_ptr<const cuda::DeviceForest> device =
        used == Device::Cuda ? copy_to_device(learned.forest.flat(), progress.part(0, 0)) : nullptr;
    const Progress alone = progress.part(0, 0).on_one_thread();
    parallel_for(static_cast<int>(views.size()), progress, [&](int i) {
      const ViewIndex view = views[static_cast<std::size_t>(i)];
      Features of_view = find_features(view);
      if (!of_view) of_view = compute_features(view, alone);
      const PixelVotes votes = device ? PixelVotes(learned.forest, of_view->view(), *device, alone)
                                      : PixelVotes(learned.forest, of_view->view(), alone);
      into.view(view) = predict_one(learned, view, *of_view, votes, alone);
    });
  }

  void find_edges(ViewRectangle views, const Progress& progress) {
    if (edges && covers(*edges, views)) return;
    const DisparityField none;
    const bool sees_disparity = set.with_disparity && disparity;
    edges = std::make_shared<const ViewStack<float>>(
        edge_probabilities(*light_field, views, sees_disparity ? *disparity : none, {}, progress,
                           sees_disparity ? confidence.get() : nullptr));
    has_own_edges = true;
  }

  /// Replaces the labels by regularized ones.
  void regularize(const Learned& learned, Labeling& labeling, const Progress& progress) {
    LabelProbabilities& own = labeling.probabilities;
    if (own.grid.count() > 1) {
      const ViewIndex middle{own.first.v + own.grid.v / 2, own.first.u + own.grid.u / 2};
      judge(learned, middle, own, progress.part(0, 0.05));
      regularize_together(learned.scribbles, learned.parameters, labeling, progress.part(0.05, 1));
    } else {
      regularize_alone(learned, labeling, progress);
    }
  }

  /// Has the colors beside boundaries speak for labels, unless disparity that is right does.
  void judge(const Learned& learned, ViewIndex reference, LabelProbabilities& own,
             const Progress& progress) {
    if (set.with_disparity && !confidence) return;
    progress.step("finding edges");
    find_edges({own.first, own.grid}, progress.part(0, 0.5));
    RayLabelingInput input = input_of(nullptr, &learned.scribbles);
    if (keeps_solvers) input.kept = &reference_solver;
    reweight_by_color(input, reference, options_of(learned.parameters), progress.part(0.5, 1), own);
  }

  [[nodiscard]] RayLabelingInput input_of(const LabelProbabilities* probabilities,
                                          const Scribbles* strokes) const {
    return {probabilities, disparity.get(), edges.get(), light_field.get(), nullptr, strokes};
  }

  static RayLabelingParameters options_of(const LabelerParameters& parameters) {
    RayLabelingParameters options;
    options.smoothness = parameters.smoothness;
    return options;
  }

  void regularize_together(const Scribbles& strokes, const LabelerParameters& parameters,
                           Labeling& labeling, const Progress& progress) {
    const LabelProbabilities& own = labeling.probabilities;
    progress.step("finding edges");
    find_edges({own.first, own.grid}, progress.part(0, 0.05));
    RayLabelingParameters options = options_of(parameters);
    const RayLabelingInput input = input_of(&own, &strokes);
    compute([&] {
      options.device = used;
      set_labels(label_rays(input, parameters.regularizer, options, progress.part(0.05, 1)),
                 labeling);
    });
  }

  void regularize_alone(const Learned& learned, Labeling& labeling, const Progress& progress) {
    const Regularizer regularizer = learned.parameters.regularizer;
    LabelProbabilities& own = labeling.probabilities;
    ViewRectangle views{own.first, own.grid};
    // Where rays of other views agree, two of them are nearly as informative as all.
    if (joins_views(regularizer)) views = adjacent_views(own.first, light_field->grid());
    progress.step("finding edges");
    find_edges(views, progress.part(0, 0.05));
    RayLabelingParameters options = options_of(learned.parameters);
    options.gap = kLiveGap;
    LabelProbabilities around = empty_probabilities(own.ids, views);
    around.view(own.first) = std::move(own.views[0]);
    progress.step("labeling neighboring views");
    predict(learned, around, progress.part(0.05, 0.3));
    judge(learned, own.first, around, progress.part(0.3, 0.5));
    RayLabelingInput input = input_of(&around, &learned.scribbles);
    if (keeps_solvers) input.kept = &own_solver;
    progress.step("regularizing");
    set_labels(label_view(input, own.first, regularizer, options, progress.part(0.5, 1)), labeling);
    own.views[0] = std::move(around.view(own.first));
  }

  void take_most_probable(Labeling& labeling, const Progress& progress) const {
    labeling.labels = label_rays({&labeling.probabilities}, Regularizer::None, {}, progress).labels;
    clear_invalid(labeling.labels);
  }

  void set_labels(RayLabeling result, Labeling& labeling) const {
    labeling.gap = result.relative_gap();
    labeling.labels = std::move(result.labels);
    clear_invalid(labeling.labels);
  }

  // What was not seen has no label.
  void clear_invalid(ViewStack<std::int32_t>& labels) const {
    if (light_field->valid().empty()) return;
    for (int i = 0; i < labels.grid().count(); ++i) {
      const ViewIndex view = labels.view_at(i);
      clear_invalid(view, labels.view(view));
    }
  }

  void clear_invalid(ViewIndex view, ImageView<std::int32_t> labels) const {
    const ImageView<const std::uint8_t> valid = light_field->valid_of(view);
    if (valid.empty()) return;
    std::transform(labels.data, labels.data + labels.size(), valid.data, labels.data,
                   [](std::int32_t id, std::uint8_t is_valid) { return is_valid ? id : 0; });
  }
};

Labeler::Labeler(LightFieldPtr light_field, std::shared_ptr<const DisparityField> disparity,
                 std::shared_ptr<const ViewStack<float>> edges,
                 std::shared_ptr<const ViewStack<float>> confidence)
    : state_(std::make_unique<State>()) {
  state_->light_field = std::move(light_field);
  state_->disparity = std::move(disparity);
  state_->edges = std::move(edges);
  state_->confidence = std::move(confidence);
}

Labeler::~Labeler() = default;
Labeler::Labeler(Labeler&&) noexcept = default;
Labeler& Labeler::operator=(Labeler&&) noexcept = default;

void Labeler::compute_on(Device device) {
  state_->asked = device;
}

Labeling Labeler::label(const Scribbles& scribbles, const LabelerParameters& parameters,
                        ViewRectangle views, const Progress& progress,
                        const std::function<void(const Labeling&)>& on_draft) {
  const Stopwatch watch;
  const LightField& lf = *state_->light_field;
  require_views(views, lf.grid());
  const std::vector<std::int32_t> ids = painted_labels(scribbles, lf);
  const Regularizer regularizer = parameters.regularizer;
  require_disparity(regularizer, state_->disparity != nullptr);
  state_->use({uses_disparity(parameters)});
  state_->choose_device(views.grid.count());

  const bool are_few = views.grid.count() <= static_cast<int>(kKeptViews);
  state_->begin(on_draft && regularizer != Regularizer::None && are_few, ids);
  const Learned learned = state_->learn(scribbles, ids, parameters, progress.part(0, 0.1));
  progress.step(kLabelingStep);
  Labeling labeling;
  labeling.probabilities = empty_probabilities(ids, views);
  state_->compute(
      [&] { state_->predict(learned, labeling.probabilities, progress.part(0.1, 0.5)); });
  // Not painting: the following steps need the memory.
  if (labeling.probabilities.views.size() > kKeptViews) state_->forget_views();
  if (regularizer == Regularizer::None || on_draft) {
    state_->take_most_probable(labeling, progress.part(0.5, 0.5));
  }
  if (regularizer != Regularizer::None) {
    if (on_draft) {
      labeling.is_draft = true;
      labeling.seconds = watch.seconds();
      on_draft(labeling);
      labeling.is_draft = false;
    }
    state_->complete(learned, labeling.probabilities, progress.part(0.5, 0.5));
    state_->regularize(learned, labeling, progress.part(0.5, 1));
  }
  labeling.note = state_->note;
  labeling.seconds = watch.seconds();
  return labeling;
}

std::optional<Labeling> Labeler::correct(const Scribbles& scribbles,
                                         const LabelerParameters& parameters,
                                         const LabelCorrection& correction,
                                         const Progress& progress) {
  const Stopwatch watch;
  const std::vector<std::int32_t> ids = painted_labels(scribbles, *state_->light_field);
  const Labeling& before = correction.before;
  if (!state_->can_correct(parameters, before) ||
      !std::ranges::includes(ids, before.probabilities.ids)) {
    return std::nullopt;
  }
  state_->use({uses_disparity(parameters)});
  progress.step(kLabelingStep);
  const GridShape grid = state_->light_field->grid();
  State::Corrected corrected{
      scribbles, empty_probabilities(ids, {{0, 0}, grid}),
      ChangedRays(grid, before.labels.height(), before.labels.width(), 1, {0, 0},
                  allocate_large_zeros),
      state_->find_news(scribbles, ids, parameters, correction, progress.part(0, 0.3))};
  RayLabeling rays = state_->solve_news(parameters, correction, progress.part(0.3, 1), corrected);
  Labeling labeling;
  labeling.gap = std::max(before.gap, rays.relative_gap());
  labeling.labels = std::move(rays.labels);
  state_->clear_invalid(labeling.labels);
  labeling.probabilities = std::move(corrected.probabilities);
  labeling.seconds = watch.seconds();
  return labeling;
}

void Labeler::prepare_correction(const Scribbles& scribbles, const LabelerParameters& parameters,
                                 ViewIndex view, const Progress& progress) {
  state_->use({uses_disparity(parameters)});
  static_cast<void>(state_->say(scribbles, parameters, view, progress.part(0, 0.3)));
  progress.step("finding edges");
  state_->find_edges({{0, 0}, state_->light_field->grid()}, progress.part(0.3, 0.9));
  state_->find_colors(progress.part(0.9, 1));
}

Labeling Labeler::smooth(LabelProbabilities probabilities, const Scribbles& scribbles,
                         const LabelerParameters& parameters, const Progress& progress) {
  const Stopwatch watch;
  require_disparity(parameters.regularizer, state_->disparity != nullptr);
  if (probabilities.grid != state_->light_field->grid()) {
    throw InvalidInput("probabilities of all views are needed to label all views");
  }
  state_->use({uses_disparity(parameters)});
  state_->choose_device(probabilities.grid.count());
  Labeling labeling;
  labeling.probabilities = std::move(probabilities);
  state_->regularize_together(scribbles, parameters, labeling, progress);
  labeling.note = state_->note;
  labeling.seconds = watch.seconds();
  return labeling;
}

Names<FeatureSet> names_of(FeatureSet) {
  return {{FeatureSet::Image, "image"},
          {FeatureSet::ImageEstimate, "image+estimate", "image and estimate"},
          {FeatureSet::ImageTruth, "image+truth", "image and ground truth"}};
}

Schema<LabelerParameters> labeler_schema() {
  return Schema<LabelerParameters>()
      .choice("features", &LabelerParameters::features,
              {"Features",
               "Features that the forest uses: of the image alone, or of disparity as well"})
      .choice("regularizer", &LabelerParameters::regularizer,
              {"Smoothing",
               "How labels are made consistent: not at all, view by view, along the rays of all "
               "views (rayspace), or by minimizing one energy of all views (wsg13; slower, 16 "
               "bytes per ray and label)"})
      .real("smoothness", &LabelerParameters::smoothness,
            {"Smoothness", "Cost of one pixel of boundary between labels, in units of -log p", ""},
            {0, 200})
      .real("nearness", &LabelerParameters::nearness,
            {"Nearness",
             "Influence of the distance to the strokes of a label, measured along surfaces"},
            {0, 5})
      .integer("trees", &LabelerParameters::trees, {"Trees", "Number of trees of the forest"},
               {4, 500})
      .integer("depth", &LabelerParameters::depth, {"Depth", "Maximum depth of a tree"}, {1, 25})
      .integer("seed", &LabelerParameters::seed,
               {"Seed", "Seed of the random numbers used to train the forest"}, {0, 1000000});
}

}  // namespace episcope
