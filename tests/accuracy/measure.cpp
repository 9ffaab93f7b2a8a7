// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/measure.h"

#include "engine/evaluation/metrics/metrics.h"

#include <cstdio>
#include <limits>

namespace episcope::accuracy {
namespace {

double metric(const Evaluation& evaluation, const char* key) {
  return find_metric(evaluation.metrics, key).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Measurement measure(const std::string& name, const Scene& scene, const Estimator& estimator,
                    const MeasuredRun& run, const Progress& progress) {
  const ViewIndex center = scene.light_field->center();
  const auto views = estimator.info.all_views ? run.views : ViewSelection::Center;
  const Estimate estimate =
      estimator.run(*scene.light_field, run.values, {.views = views}, progress);
  const auto judge = [&](Protocol protocol) {
    return evaluate(estimate.field.view(center), scene.truth->field.view(center), {},
                    {.protocol = protocol});
  };
  const Evaluation of_paper = judge(Protocol::Vmv2013);
  const Evaluation of_benchmark = judge(Protocol::Benchmark2016);
  Measurement result;
  result.scene = name;
  result.method = estimator.info.name;
  result.mse_100 = metric(of_paper, "mse_100");
  result.mse_100_inset15 = metric(of_paper, "mse_100_inset15");
  result.badpix_0070 = metric(of_benchmark, "badpix_0070");
  result.seconds = estimate.seconds;
  result.views = estimate.field.disparity.grid().count();
  result.range = estimate.range;
  return result;
}

std::string table_head() {
  return "| scene | method | MSE×100 | MSE×100, inset 15 | BadPix(0.07) % | seconds | views | "
         "range px "
         "|\n|---|---|---:|---:|---:|---:|---:|---|\n";
}

std::string table_row(const Measurement& m) {
  char text[300];
  std::snprintf(text, sizeof text, "| %s | %s | %.3f | %.3f | %.2f | %.2f | %d | %.2f to %.2f |\n",
                m.scene.c_str(), m.method.c_str(), m.mse_100, m.mse_100_inset15, m.badpix_0070,
                m.seconds, m.views, m.range.min, m.range.max);
  return text;
}

}  // namespace episcope::accuracy
