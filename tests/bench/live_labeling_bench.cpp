// SPDX-License-Identifier: BSD-3-Clause
// Labels of the center view of 9×9 views of 512×512 pixels after a stroke, as the window asks for
// them: the draft, the refined labels, and those of another view after the same strokes; against a
// labeler that knows nothing yet, in the same run. The demo scene (11 labels), or the archive
// folder still_life (13) where EPISCOPE_SHARED_DATA names its parent.
#include "engine/disparity/registry.h"
#include "engine/evaluation/label_quality.h"
#include "engine/io/open.h"
#include "engine/labeling/labeler.h"
#include "engine/scenes/builtin.h"
#include "tests/accuracy/strokes.h"
#include "tests/bench/bench_scene.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace {

using namespace episcope;

constexpr int kStrokeLength = 30;

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Scene open_bench_scene() {
  const char* shared = std::getenv("EPISCOPE_SHARED_DATA");
  if (shared != nullptr && std::filesystem::exists(std::filesystem::path(shared) / "still_life")) {
    return io::open_scene(std::filesystem::path(shared) / "still_life", {}, Progress());
  }
  return scenes::render_builtin("demo", {}, Progress());
}

struct Bench {
  Scene scene = open_bench_scene();
  std::shared_ptr<const DisparityField> disparity;
  std::shared_ptr<const ViewStack<float>> confidence;
  double disparity_seconds = 0;

  Bench() {
    const double start = bench::now();
    auto estimate = std::make_shared<Estimate>(find_estimator("epi_s").run(
        *scene.light_field, {}, {.views = ViewSelection::All}, Progress()));
    disparity = {estimate, &estimate->field};
    confidence = {estimate, &estimate->confidence};
    disparity_seconds = bench::now() - start;
  }
  static const Bench& get() {
    static const Bench kept;
    return kept;
  }
  [[nodiscard]] ViewIndex center() const { return scene.light_field->center(); }
  [[nodiscard]] Labeler labeler() const {
    return {scene.light_field, disparity, nullptr, confidence};
  }
};

/// Paints one more short stroke on the center view, of the label that is truly there.
void paint(const Scene& scene, int number, Scribbles& scribbles) {
  const ViewIndex center = scene.light_field->center();
  const auto view = std::ranges::find(scribbles.views, center, &ViewScribbles::view);
  const auto truth = scene.truth->labels.view(center);
  const int y = 20 + number * 37 % (truth.height - 40);
  const int x = 20 + number * 61 % (truth.width - 40 - kStrokeLength);
  for (int i = 0; i < kStrokeLength; ++i) view->labels.at(y, x + i) = truth.at(y, x);
}

struct Times {
  double draft = 0;
  double draft_processor = 0;
  double refined = 0;
  double refined_processor = 0;
  double right = 0;  // Share of pixels, refined; the newest.

  void keep_least(const Times& other) {
    draft = std::min(draft, other.draft);
    draft_processor = std::min(draft_processor, other.draft_processor);
    refined = std::min(refined, other.refined);
    refined_processor = std::min(refined_processor, other.refined_processor);
    right = other.right;
  }
};

Times measure(Labeler& labeler, const Scene& scene, const Scribbles& scribbles, ViewIndex view) {
  Times times;
  const double start = bench::now();
  const double processor = processor_seconds();
  const Labeling refined =
      labeler.label(scribbles, {}, {view, {1, 1}}, Progress(), [&](const Labeling&) {
        times.draft = bench::now() - start;
        times.draft_processor = processor_seconds() - processor;
      });
  times.refined = bench::now() - start;
  times.refined_processor = processor_seconds() - processor;
  times.right =
      judge_labels(refined.labels.view(view), scene.truth->labels.view(view)).share().value_or(0);
  return times;
}

void report(benchmark::State& state, const Times& least, const Times& whole) {
  state.counters["draft_s"] = least.draft;
  state.counters["draft_cpu_s"] = least.draft_processor;
  state.counters["refined_s"] = least.refined;
  state.counters["refined_cpu_s"] = least.refined_processor;
  state.counters["right_share"] = least.right;
  state.counters["draft_times_faster"] = whole.draft / least.draft;
  state.counters["refined_times_faster"] = whole.refined / least.refined;
}

Times of_new_labeler(const Bench& bench) {
  std::optional<Times> least;
  for (int i = 0; i < 2; ++i) {
    Labeler labeler = bench.labeler();
    const Times times = measure(labeler, bench.scene, bench.scene.scribbles, bench.center());
    least ? least->keep_least(times) : void(least = times);
  }
  return *least;
}

void first_labels(benchmark::State& state) {
  const Bench& bench = Bench::get();
  Times whole;
  for (auto _ : state) whole = of_new_labeler(bench);
  report(state, whole, whole);
  state.counters["disparity_s"] = bench.disparity_seconds;
}

void after_a_stroke(benchmark::State& state) {
  const Bench& bench = Bench::get();
  const Times whole = of_new_labeler(bench);
  Labeler labeler = bench.labeler();
  Scribbles scribbles = bench.scene.scribbles;
  measure(labeler, bench.scene, scribbles, bench.center());
  std::optional<Times> least;
  int number = 0;
  for (auto _ : state) {
    paint(bench.scene, number++, scribbles);
    const Times times = measure(labeler, bench.scene, scribbles, bench.center());
    least ? least->keep_least(times) : void(least = times);
  }
  report(state, *least, whole);
}

void in_the_next_view(benchmark::State& state) {
  const Bench& bench = Bench::get();
  const Times whole = of_new_labeler(bench);
  Labeler labeler = bench.labeler();
  measure(labeler, bench.scene, bench.scene.scribbles, bench.center());
  std::optional<Times> least;
  ViewIndex view = bench.center();
  for (auto _ : state) {
    view.u = view.u == bench.center().u ? view.u - 1 : view.u + 1;
    const Times times = measure(labeler, bench.scene, bench.scene.scribbles, view);
    least ? least->keep_least(times) : void(least = times);
  }
  report(state, *least, whole);
}

double right_share(const Bench& bench, const Labeling& labeling) {
  return judge_labels(labeling.labels, bench.scene.truth->labels).share().value_or(0);
}

/// Of the strokes of each label on the center view, what lies near its first pixel.
Scribbles first_dots(const Scene& scene) {
  constexpr int kDot_px = 15;
  Scribbles scribbles = scene.scribbles;
  Image<std::int32_t>& strokes =
      std::ranges::find(scribbles.views, scene.light_field->center(), &ViewScribbles::view)->labels;
  std::map<std::int32_t, PixelIndex> first;
  for (int y = 0; y < strokes.height(); ++y) {
    for (int x = 0; x < strokes.width(); ++x) {
      const PixelIndex at = first.try_emplace(strokes.at(y, x), y, x).first->second;
      if (y - at.y > kDot_px || std::abs(x - at.x) > kDot_px) strokes.at(y, x) = 0;
    }
  }
  return scribbles;
}

// Labels of all views, corrected after strokes on what is wrong, against labels from nothing.
void all_views_after_a_stroke(benchmark::State& state) {
  const Bench& bench = Bench::get();
  const ViewRectangle everything{{0, 0}, bench.scene.light_field->grid()};
  Labeler labeler = bench.labeler();
  Scribbles scribbles = first_dots(bench.scene);
  const double whole = bench::now();
  const double whole_processor = processor_seconds();
  Labeling labeling = labeler.label(scribbles, {}, everything, Progress());
  state.counters["anew_s"] = bench::now() - whole;
  state.counters["anew_cpu_s"] = processor_seconds() - whole_processor;
  state.counters["right_share_before"] = right_share(bench, labeling);
  labeler.prepare_correction(scribbles, {}, bench.center(), Progress());
  const ImageView<const std::int32_t> truth = bench.scene.truth->labels.view(bench.center());
  double in_sight = 0, in_sight_processor = 0, all = 0, all_processor = 0;
  for (auto _ : state) {
    const Scribbles former = scribbles;
    const auto painted = std::ranges::find(scribbles.views, bench.center(), &ViewScribbles::view);
    accuracy::add_correction(labeling.labels.view(bench.center()), truth, painted->labels.view());
    const double start = bench::now();
    const double processor = processor_seconds();
    auto corrected = labeler.correct(scribbles, {},
                                     {labeling, former, bench.center(),
                                      [&](ViewIndex view, const Image<std::int32_t>&) {
                                        if (!(view == bench.center())) return;
                                        in_sight = std::max(in_sight, bench::now() - start);
                                        in_sight_processor = std::max(
                                            in_sight_processor, processor_seconds() - processor);
                                      }},
                                     Progress());
    all = std::max(all, bench::now() - start);
    all_processor = std::max(all_processor, processor_seconds() - processor);
    labeling = std::move(*corrected);
  }
  state.counters["in_sight_s"] = in_sight;
  state.counters["in_sight_cpu_s"] = in_sight_processor;
  state.counters["all_s"] = all;
  state.counters["all_cpu_s"] = all_processor;
  state.counters["right_share"] = right_share(bench, labeling);
  state.counters["right_share_anew"] =
      right_share(bench, labeler.label(scribbles, {}, everything, Progress()));
}

BENCHMARK(first_labels)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);
BENCHMARK(after_a_stroke)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(3);
BENCHMARK(all_views_after_a_stroke)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(8);
BENCHMARK(in_the_next_view)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(3);

}  // namespace

BENCHMARK_MAIN();
