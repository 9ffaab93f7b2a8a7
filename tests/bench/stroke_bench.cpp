// SPDX-License-Identifier: BSD-3-Clause
// One segment of a stroke on a 1024×1024 view, as it is painted and shown, against the plain way:
// to ask for every pixel of the view whether the brush covers it. A frame of the screen lasts 16
// ms.
#include "annotation/brush.h"
#include "annotation/likeness.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace {

using namespace episcope;

constexpr int kSize = 1024;

/// Points of a hand that moves fast: 40 px from one to the next.
StrokePoint point_at(int i) {
  const double turn = i * 0.1;
  return {kSize / 2 + 400 * std::sin(turn), kSize / 2 + 400 * std::cos(turn)};
}

AnnotationDocument new_document() {
  AnnotationDocument document({1, 1}, kSize, kSize);
  document.add_label();
  return document;
}

void paint_plainly(Image<std::uint8_t>& view, StrokePoint a, StrokePoint b, double diameter_px) {
  const double dy = b.y - a.y;
  const double dx = b.x - a.x;
  const double length2 = dy * dy + dx * dx;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double py = y + 0.5 - a.y;
      const double px = x + 0.5 - a.x;
      const double along = std::clamp((py * dy + px * dx) / length2, 0.0, 1.0);
      const double ey = py - along * dy;
      const double ex = px - along * dx;
      if (ey * ey + ex * ex <= diameter_px * diameter_px / 4) view.at(y, x) = 1;
    }
  }
}

double plain_seconds(double diameter_px) {
  Image<std::uint8_t> view(kSize, kSize);
  double best = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto start = std::chrono::steady_clock::now();
    paint_plainly(view, point_at(i), point_at(i + 1), diameter_px);
    benchmark::DoNotOptimize(view.data());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    best = std::min(best, took.count());
  }
  return best;
}

void stroke_segment(benchmark::State& state) {
  const auto diameter_px = static_cast<double>(state.range(0));
  const double plain = plain_seconds(diameter_px);
  AnnotationDocument document = new_document();
  Stroke stroke(document, {0, 0}, {PaintTool::Brush, 1, diameter_px, false});
  stroke.extend(point_at(0));
  int i = 1;
  for (auto _ : state) benchmark::DoNotOptimize(stroke.extend(point_at(i++)));
  // A rate is divided by the seconds spent.
  state.counters["times_faster"] = benchmark::Counter(
      plain * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}
BENCHMARK(stroke_segment)->Arg(1)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

/// Setting the brush down, 20 segments, and keeping the stroke as an edit.
void whole_stroke(benchmark::State& state) {
  AnnotationDocument document = new_document();
  int turn = 0;
  for (auto _ : state) {
    const PaintTool tool = turn++ % 2 == 0 ? PaintTool::Brush : PaintTool::Eraser;
    Stroke stroke(document, {0, 0}, {tool, 1, static_cast<double>(state.range(0)), false});
    for (int i = 0; i <= 20; ++i) stroke.extend(point_at(i));
    benchmark::DoNotOptimize(stroke.commit());
  }
}
BENCHMARK(whole_stroke)->Arg(10)->Arg(100)->Unit(benchmark::kMicrosecond);

void fill_of_a_whole_view(benchmark::State& state) {
  const Image<float> picture(kSize, kSize, 3, 0.5F);
  for (auto _ : state) {
    benchmark::DoNotOptimize(Likeness(picture.view(), {}).region({5, 5}, 8));
  }
}
BENCHMARK(fill_of_a_whole_view)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
