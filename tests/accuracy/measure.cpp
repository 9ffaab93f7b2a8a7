// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/measure.h"

#include "engine/evaluation/metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace episcope::accuracy {
namespace {

double metric(const Evaluation& evaluation, const char* key) {
  return find_metric(evaluation.metrics, key).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Interval true_range(const Scene& scene) {
  const DisparityView view = scene.truth->field.view(scene.light_field->center());
  Interval range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (int y = 0; y < view.disparity.height; ++y) {
    for (int x = 0; x < view.disparity.width; ++x) {
      if (!view.is_valid(y, x)) continue;
      const double disparity = view.disparity.at(y, x);
      range = {std::min(range.min, disparity), std::max(range.max, disparity)};
    }
  }
  return range;
}

Measurement measure(const std::string& name, const Scene& scene, const Estimator& estimator,
                    const ParameterSet& values, ViewSelection views, const Progress& progress) {
  const ViewIndex center = scene.light_field->center();
  if (!estimator.info.all_views) views = ViewSelection::Center;
  const Estimate estimate = estimator.run(*scene.light_field, values, {.views = views}, progress);
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
  result.truth = true_range(scene);
  return result;
}

std::string table_head() {
  return "| set | scene | method | MSE×100 | MSE×100, inset 15 | BadPix(0.07) % | seconds | views "
         "| range px | truth px |\n|---|---|---|---:|---:|---:|---:|---:|---|---|\n";
}

std::string table_row(const Measurement& m) {
  return fmt::format(
      "| {} | {} | {} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {} | {:.2f} to {:.2f} | {:.2f} to "
      "{:.2f} |\n",
      m.group, m.scene, m.method, m.mse_100, m.mse_100_inset15, m.badpix_0070, m.seconds, m.views,
      m.range.min, m.range.max, m.truth.min, m.truth.max);
}

}  // namespace episcope::accuracy
