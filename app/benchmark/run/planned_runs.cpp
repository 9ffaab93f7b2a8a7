// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/planned_runs.h"

#include "app/benchmark/run/label_runs.h"
#include "engine/evaluation/tables/parameter_search.h"

namespace episcope {
namespace {

BenchmarkRun table_run(const Estimator& method, const BenchmarkOptions& options) {
  const bool all = method.info.all_views && options.views == ViewSelection::All;
  const ViewSelection views = all ? ViewSelection::All : ViewSelection::Center;
  return plan_run(method, {}, {.views = views, .device = options.device}, RunKind::Table);
}

}  // namespace

std::vector<PlannedRun> planned_runs(const BenchmarkOptions& options) {
  std::vector<PlannedRun> runs;
  const std::vector<Estimator>& methods = options.methods;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    runs.push_back({table_run(methods[i], options), i});
  }
  for (std::size_t i = 0; i < options.labels.size(); ++i) {
    runs.push_back({plan_label_run(options.labels[i]), i});
  }
  for (std::size_t i = 0; options.has_search && i < methods.size(); ++i) {
    for (ParameterSet& point : search_grid(methods[i].parameters)) {
      runs.push_back(
          {plan_run(methods[i], point, {.views = ViewSelection::Center, .device = options.device},
                    RunKind::Search),
           i, std::move(point)});
    }
  }
  return runs;
}

}  // namespace episcope
