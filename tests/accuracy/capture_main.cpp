// SPDX-License-Identifier: BSD-3-Clause
// Prints a Markdown table: from photographs of the synthesized gantry to ground truth, seed by
// seed.
#include "engine/core/error.h"
#include "tests/engine/capture/capture_way.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <vector>

namespace {

using namespace episcope;
using namespace episcope::accuracy;

constexpr int kSamples = 800;

struct Request {
  capture::DemoOptions options;
  unsigned first = 1;
  int seeds = 10;
};

void print_row(unsigned seed, const CaptureErrors& e, double seconds) {
  fmt::print(
      "| {} | {:.2f} | {:.3f} | {:.4f} | {:.2f} | {:.2f} | {:.4f} | {:.4f} | {} / {} | {:.1f} |\n",
      seed, e.rows_before.percentile_95, e.rows_after.percentile_95, e.gain, e.tz, e.delta_tz,
      e.disparity_median, e.disparity_99, e.missed, e.jumps, seconds);
  std::fflush(stdout);
}

void print_worst(const std::vector<CaptureErrors>& all) {
  const auto worst = [&](auto member) {
    double largest = 0;
    for (const CaptureErrors& e : all) largest = std::max(largest, member(e));
    return largest;
  };
  const auto within =
      std::ranges::count_if(all, [](const CaptureErrors& e) { return e.tz <= 2 * e.delta_tz; });
  int missed = 0;
  for (const CaptureErrors& e : all) missed += e.missed;
  fmt::print(
      "\n{} seeds, worst: rows {:.3f} px, disparity {:.4f} px in the median and {:.4f} px for "
      "99 %; tz within 2 Δtz in {}; {} discontinuities missed\n",
      all.size(), worst([](const auto& e) { return e.rows_after.percentile_95; }),
      worst([](const auto& e) { return e.disparity_median; }),
      worst([](const auto& e) { return e.disparity_99; }), within, missed);
}

void print_table(const Request& request) {
  fmt::print(
      "| seed | rows before | rows after | gain | tz, mm | Δtz, mm | disparity, median | 99 % | "
      "missed jumps | s |\n|---|---|---|---|---|---|---|---|---|---|\n");
  std::vector<CaptureErrors> all;
  for (unsigned seed = request.first; all.size() < static_cast<std::size_t>(request.seeds);
       ++seed) {
    const auto begin = std::chrono::steady_clock::now();
    capture::DemoOptions options = request.options;
    options.seed = seed;
    const CaptureErrors errors = capture_errors(go_capture_way(options, Progress()), kSamples);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    print_row(seed, errors, taken.count());
    all.push_back(errors);
  }
  print_worst(all);
}

int run(int argc, char** argv) {
  CLI::App app("Errors of the way from photographs of the synthesized gantry to ground truth");
  Request request;
  request.options.height = 300;
  request.options.width = 400;
  request.options.detail = 50;
  app.add_option("--first", request.first, "First seed")->capture_default_str();
  app.add_option("--seeds", request.seeds, "How many")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--jitter", request.options.jitter_px, "Of the gantry, in px")
      ->capture_default_str();
  app.add_option("--detail", request.options.detail, "Of the mesh")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  print_table(request);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
