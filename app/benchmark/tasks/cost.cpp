// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/tasks/cost.h"

#include <array>
#include <string_view>

namespace episcope {
namespace {

/// Nanoseconds of processor time for each sample of a 9×9 light field.
struct MethodCost {
  std::string_view id;
  double all_views = 0;
  double center = 0;
};

constexpr std::array kCosts{
    MethodCost{"epi_l", 100, 100},
};

constexpr MethodCost kOther{"", 2000, 2000};  // labels, and methods that are not in the table
constexpr double kOpeningCost = 30;
constexpr double kLeastSeconds = 0.01;

MethodCost cost_of(std::string_view method) {
  for (const MethodCost& cost : kCosts) {
    if (cost.id == method) return cost;
  }
  return kOther;
}

}  // namespace

double estimated_seconds(const BenchmarkRun& run, const SceneSize& size) {
  const MethodCost cost = cost_of(run.method);
  const double each = run.views == ViewSelection::All ? cost.all_views : cost.center;
  return kLeastSeconds + 1e-9 * each * static_cast<double>(size.views * size.pixels);
}

double opening_seconds(const SceneSize& size) {
  return kLeastSeconds + 1e-9 * kOpeningCost * static_cast<double>(size.views * size.pixels);
}

}  // namespace episcope
