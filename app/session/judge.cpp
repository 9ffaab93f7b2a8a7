// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/judge.h"

#include "engine/core/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <utility>

namespace episcope {
namespace {

// An evaluation of 512×512 pixels takes 1.5 MB.
constexpr std::size_t kKept = 48;
// Of each estimate, however many there are: what tables and pictures ask for again and again, by
// either protocol and in the view that is looked at.
constexpr std::ptrdiff_t kKeptOfEach = 3;

// 1 in the part; empty for an empty part.
Image<std::uint8_t> mask_of(const PixelRect& part, const LightField& light_field) {
  if (part.empty()) return {};
  Image<std::uint8_t> mask(light_field.height(), light_field.width());
  for (int y = part.y0; y < part.y1; ++y) {
    for (int x = part.x0; x < part.x1; ++x) mask.at(y, x) = 1;
  }
  return mask;
}

}  // namespace

EvaluationCache::EvaluationCache(const JobRunner::Post& post, std::function<void()> on_evaluated)
    : on_evaluated_(std::move(on_evaluated)), runner_(post) {}

std::list<EvaluationCache::Entry>::iterator EvaluationCache::find(const EvaluationKey& key) {
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const Entry& entry) { return entry.key == key; });
}

EvaluationPtr EvaluationCache::find_or_begin(const EvaluationKey& key, const EstimatePtr& estimate,
                                             const std::shared_ptr<const Scene>& scene,
                                             const PixelRect& part) {
  if (!estimate || !scene || !can_judge(*estimate, *scene, key.view)) return nullptr;
  if (const auto found = find(key); found != entries_.end()) {
    entries_.splice(entries_.begin(), entries_, found);
    return found->evaluation;
  }
  entries_.push_front({.key = key});
  trim();
  ++pending_;
  entries_.front().job = runner_.start<EvaluationPtr>(
      [key, estimate, scene, part](const Progress& progress) {
        progress.check();
        const Image<std::uint8_t> asked = mask_of(part, *scene->light_field);
        EvaluationOptions options{.protocol = key.protocol, .progress = progress};
        if (!part.empty()) options.shown = asked.view();
        return std::make_shared<const Evaluation>(
            judge(*estimate, *scene, std::move(options), key.view));
      },
      [this, key](Outcome<EvaluationPtr> outcome) { finish(key, std::move(outcome)); });
  return nullptr;
}

void EvaluationCache::finish(const EvaluationKey& key, Outcome<EvaluationPtr> outcome) {
  --pending_;
  if (const auto found = find(key); found != entries_.end()) {
    found->is_under_way = false;
    if (outcome.value) found->evaluation = std::move(*outcome.value);
  }
  on_evaluated_();
}

void EvaluationCache::forget(int estimate) {
  entries_.remove_if([&](const Entry& entry) {
    if (entry.key.estimate != estimate) return false;
    runner_.cancel(entry.job);
    return true;
  });
}

void EvaluationCache::trim() {
  const auto count_of = [&](int estimate) {
    return std::ranges::count(entries_, estimate,
                              [](const Entry& entry) { return entry.key.estimate; });
  };
  for (auto end = entries_.end(); entries_.size() > kKept && end != entries_.begin();) {
    const auto oldest = std::prev(end);
    const bool stays = oldest->is_under_way || count_of(oldest->key.estimate) <= kKeptOfEach;
    end = stays ? oldest : entries_.erase(oldest);
  }
}

namespace {

ViewIndex view_of(const DisparityField& field, const LightField& light_field) {
  const ViewIndex center = light_field.center();
  return field.empty() || field.contains(center) ? center : field.disparity.first();
}

// Whether both are in two layers. The truth of such a scene may have a single map as well.
bool compares_layers(const Estimate& estimate, const GroundTruth& truth) {
  return truth.has_layers() && !estimate.layered.foreground.empty() &&
         !estimate.layered.background.empty();
}

void require_truth(const Scene& scene, ViewIndex view) {
  const GroundTruth& truth = *scene.truth;
  const std::string& name = scene.light_field->info().name;
  if (!truth.has_disparity()) {
    throw InvalidInput(name + (truth.has_layers()
                                   ? " has truth in two layers, but the result has one"
                                   : " has no true disparity to judge against"));
  }
  if (!truth.field.contains(view)) {
    throw InvalidInput(name + " has no true disparity in view " + view_text(view));
  }
}

/// Which pixels of `asked` (empty = all) both the light field and maps that lack a border show;
/// empty = all that the light field shows.
Image<std::uint8_t> covered(const Estimate& estimate, const LightField& light_field, ViewIndex view,
                            ImageView<const std::uint8_t> asked) {
  const int border = estimate.border_px;
  if (border <= 0 && asked.empty()) return {};
  const auto shown = light_field.valid_of(view);
  Image<std::uint8_t> mask(light_field.height(), light_field.width());
  for (int y = border; y < mask.height() - border; ++y) {
    for (int x = border; x < mask.width() - border; ++x) {
      const bool is_asked = asked.empty() || asked.at(y, x) != 0;
      mask.at(y, x) = is_asked && (shown.empty() || shown.at(y, x) != 0) ? 1 : 0;
    }
  }
  return mask;
}

}  // namespace

std::string reason_against_view(const ViewRectangle& covered, ViewIndex view,
                                const std::string& who, const std::string& what) {
  if (covered.grid.count() == 0) return who + " has no " + what;
  const ViewIndex place{view.v - covered.first.v, view.u - covered.first.u};
  if (covered.grid.contains(place)) return {};
  return fmt::format("{} has {}×{} views from view {} on, but view {} was asked for", who,
                     covered.grid.v, covered.grid.u, view_text(covered.first), view_text(view));
}

ViewIndex judged_view(const Scene& scene) {
  const GroundTruth& truth = *scene.truth;
  return view_of(truth.has_disparity() ? truth.field : truth.foreground, *scene.light_field);
}

ViewIndex view_to_judge(const Estimate& estimate, const Scene& scene,
                        std::optional<ViewIndex> wanted) {
  if (wanted) return *wanted;
  const ViewStack<float>& maps = estimate.field.disparity;
  const bool is_ours_of_one = maps.grid().count() == 1 && !estimate.version.empty();
  const bool has_own = is_ours_of_one && can_judge(estimate, scene, maps.first());
  return has_own ? maps.first() : judged_view(scene);
}

void place_foreign_map(ViewIndex view, Estimate& estimate) {
  if (estimate.field.disparity.grid().count() != 1 || !estimate.version.empty()) return;
  const auto move = [&](auto& stack) {
    if (!stack.empty()) stack.keep_in_place(stack.first(), {1, 1}, view);
  };
  move(estimate.field.disparity);
  move(estimate.field.valid);
  move(estimate.confidence);
  move(estimate.second.disparity);
  move(estimate.second.valid);
}

bool can_judge(const Estimate& estimate, const Scene& scene, ViewIndex view) {
  const GroundTruth& truth = *scene.truth;
  if (compares_layers(estimate, truth)) {
    return truth.foreground.contains(view) && truth.background.contains(view) &&
           estimate.layered.foreground.contains(view) && estimate.layered.background.contains(view);
  }
  return truth.field.contains(view) && estimate.field.contains(view);
}

std::string estimated_truth_note(const Scene& scene) {
  const auto& estimated = scene.truth->estimated;
  return estimated ? "the truth of " + scene.light_field->info().name +
                         " is no ground truth: it was " + estimated_text(*estimated)
                   : std::string();
}

Evaluation judge(const Estimate& estimate, const Scene& scene, EvaluationOptions options,
                 std::optional<ViewIndex> asked_view) {
  const GroundTruth& truth = *scene.truth;
  const LightField& light_field = *scene.light_field;
  const ViewIndex view = asked_view.value_or(judged_view(scene));
  options.camera = light_field.info().camera;
  const Image<std::uint8_t> part = covered(estimate, light_field, view, options.shown);
  options.shown = part.empty() ? light_field.valid_of(view) : part.view();
  Evaluation evaluation;
  if (compares_layers(estimate, truth)) {
    LayeredEvaluation layers = evaluate_layers(estimate.layered, truth, view, options);
    layers.foreground.metrics = layered_metrics(layers);
    evaluation = std::move(layers.foreground);
  } else {
    require_truth(scene, view);
    const std::string reason =
        reason_against_view(coverage_of(estimate.field.disparity), view, "the result", "disparity");
    if (!reason.empty()) throw InvalidInput(reason);
    const std::map<std::string, Image<std::uint8_t>> no_regions;
    const bool is_center = view == light_field.center();
    options.high_res = is_center ? truth.high_res.get() : nullptr;
    options.stratified = truth.stratified;
    evaluation = evaluate(estimate.field.view(view), truth.field.view(view),
                          is_center ? truth.regions : no_regions, options);
  }
  if (std::string note = estimated_truth_note(scene); !note.empty()) {
    evaluation.notes.push_back(std::move(note));
  }
  if (options.protocol == Protocol::Benchmark2016 && estimate.seconds > 0) {
    evaluation.metrics.emplace_back("runtime_log", std::log10(estimate.seconds));
  }
  return evaluation;
}

nlohmann::ordered_json metrics_json(const Metrics& metrics) {
  auto object = nlohmann::ordered_json::object();
  for (const auto& [key, value] : metrics) object[key] = value;
  return object;
}

Metrics metrics_from(const nlohmann::ordered_json& object) {
  Metrics metrics;
  for (const auto& [key, value] : object.items()) {
    if (value.is_number()) metrics.emplace_back(key, value.get<double>());
  }
  return metrics;
}

namespace {

EvaluationPtr judge_by(Protocol protocol, const Estimate& estimate, const Scene& scene,
                       const Progress& progress, ResultScores& scores) {
  try {
    auto evaluation = std::make_shared<const Evaluation>(
        judge(estimate, scene, {.protocol = protocol, .progress = progress}));
    scores.notes.insert(scores.notes.end(), evaluation->notes.begin(), evaluation->notes.end());
    return evaluation;
  } catch (const InvalidInput& error) {
    scores.problem = error.what();
    return nullptr;
  }
}

}  // namespace

ResultScores judge_by_errors(const Estimate& estimate, const Scene& scene,
                             const Progress& progress) {
  ResultScores scores;
  scores.evaluation = judge_by(Protocol::Vmv2013, estimate, scene, progress, scores);
  if (scores.evaluation) scores.vmv2013 = scores.evaluation->metrics;
  return scores;
}

ResultScores judge_by_both(const Estimate& estimate, const Scene& scene, const Progress& progress) {
  ResultScores scores = judge_by_errors(estimate, scene, progress);
  const LightField& light_field = *scene.light_field;
  const int side = std::min(light_field.height(), light_field.width());
  if (!scores.evaluation || side <= 2 * kBenchmarkBorder) return scores;
  const auto inner = judge_by(Protocol::Benchmark2016, estimate, scene, progress, scores);
  if (inner) scores.benchmark2016 = inner->metrics;
  return scores;
}

}  // namespace episcope
