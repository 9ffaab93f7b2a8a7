// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/tasks/cost.h"

#include <array>
#include <string_view>

namespace episcope {
namespace {

/// Nanoseconds of processor time for each sample position of all views, with default parameters,
/// measured on demo:edge (9×9×128×128).
struct MethodCost {
  std::string_view id;
  double all_views = 0;
  double center = 0;
};

constexpr std::array kCosts{
    MethodCost{"epi_l", 130, 120},      MethodCost{"epi_s", 360, 150},
    MethodCost{"epi_c", 800, 800},      MethodCost{"epi_g", 150, 150},
    MethodCost{"st_av_l", 190, 190},    MethodCost{"st_av_s", 250, 250},
    MethodCost{"st_av_g", 550, 550},    MethodCost{"st_ch_l", 150, 150},
    MethodCost{"st_ch_s", 160, 160},    MethodCost{"st_ch_g", 230, 230},
    MethodCost{"kz02", 2200, 2200},     MethodCost{"epi_two_layer", 1550, 170},
    MethodCost{"plane_pm", 5700, 2300},
};

constexpr MethodCost kLabeling{"", 5000, 5000};
constexpr MethodCost kOther{"", 2000, 2000};
constexpr double kOpeningCost = 30;
constexpr double kLeastSeconds = 0.01;

MethodCost cost_of(const BenchmarkRun& run) {
  if (run.kind == RunKind::Labels) return kLabeling;
  for (const MethodCost& cost : kCosts) {
    if (cost.id == run.method) return cost;
  }
  return kOther;
}

}  // namespace

double estimated_seconds(const BenchmarkRun& run, const SceneSize& size) {
  const MethodCost cost = cost_of(run);
  const double each = run.views == ViewSelection::All ? cost.all_views : cost.center;
  return kLeastSeconds + 1e-9 * each * static_cast<double>(size.views * size.pixels);
}

double opening_seconds(const SceneSize& size) {
  return kLeastSeconds + 1e-9 * kOpeningCost * static_cast<double>(size.views * size.pixels);
}

}  // namespace episcope
