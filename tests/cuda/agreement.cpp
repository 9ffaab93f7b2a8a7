// SPDX-License-Identifier: BSD-3-Clause
#include "tests/cuda/agreement.h"

#include "engine/evaluation/metrics.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace episcope::cuda_tests {
namespace {

constexpr double kDisparityLimit = 1e-4;
constexpr double kLearnedDisparityLimit = 1e-3;
constexpr double kConfidenceLimit = 1e-3;
constexpr double kLocalShare = 0.9999;
constexpr double kLearnedShare = 0.999;
constexpr double kMseLimit = 0.005;
// A scene that a method solves exactly has an MSE of nothing: ×100, px².
constexpr double kMseSlack = 2e-4;

bool same_bits(const ViewStack<float>& a, const ViewStack<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

bool same_result(const Estimate& a, const Estimate& b) {
  return same_bits(a.field.disparity, b.field.disparity) && same_bits(a.confidence, b.confidence);
}

// Counts what is valid on both; a pixel that is valid on one alone differs without limit.
void compare_fields(const DisparityField& cpu, const DisparityField& device, double limit,
                    Agreement& result) {
  const ViewStack<float>& stack = cpu.disparity;
  std::size_t close = 0, all = 0;
  for (int i = 0; i < stack.grid().count(); ++i) {
    const ViewIndex view = stack.view_at(i);
    const DisparityView a = cpu.view(view), b = device.view(view);
    for (int y = 0; y < stack.height(); ++y) {
      for (int x = 0; x < stack.width(); ++x) {
        if (!a.is_valid(y, x) && !b.is_valid(y, x)) continue;
        const bool both = a.is_valid(y, x) && b.is_valid(y, x);
        const double off = both ? std::abs(a.disparity.at(y, x) - b.disparity.at(y, x)) : HUGE_VAL;
        ++all;
        close += off <= limit ? 1 : 0;
        result.largest = std::max(result.largest, off);
      }
    }
  }
  result.within = all > 0 ? static_cast<double>(close) / all : 1;
}

double confidence_share(const ViewStack<float>& a, const ViewStack<float>& b) {
  if (a.size() != b.size()) return 0;
  std::size_t close = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    close += std::abs(a.data()[i] - b.data()[i]) <= kConfidenceLimit ? 1 : 0;
  }
  return a.empty() ? 1 : static_cast<double>(close) / a.size();
}

double mse(const Estimate& estimate, const Scene& scene) {
  if (!scene.truth->has_disparity()) return 0;
  const ViewIndex view = scene.light_field->center();
  const Evaluation evaluation =
      evaluate(estimate.field.view(view), scene.truth->field.view(view), {}, {});
  return find_metric(evaluation.metrics, "mse_100").value_or(0);
}

}  // namespace

Agreement compare(const Case& each, const Scene& scene) {
  const auto run_on = [&](Device device) {
    return each.estimator.run(*scene.light_field, each.values,
                              {.views = each.views, .device = device}, Progress());
  };
  const Estimate cpu = run_on(Device::Cpu);
  const Estimate device = run_on(Device::Cuda);
  Agreement result;
  result.is_repeatable = same_result(device, run_on(Device::Cuda));
  const Kind kind = kind_of(each.estimator);
  compare_fields(cpu.field, device.field,
                 kind == Kind::Learned ? kLearnedDisparityLimit : kDisparityLimit, result);
  result.confidence = confidence_share(cpu.confidence, device.confidence);
  result.cpu_mse = mse(cpu, scene);
  result.device_mse = mse(device, scene);
  const double off = std::abs(result.device_mse - result.cpu_mse);
  const bool same_quality = off <= kMseLimit * result.cpu_mse + kMseSlack;
  const double share = kind == Kind::Learned ? kLearnedShare : kLocalShare;
  const bool is_close = kind == Kind::Iterative ? same_quality : result.within >= share;
  result.passes = result.is_repeatable && is_close;
  return result;
}

}  // namespace episcope::cuda_tests
