// SPDX-License-Identifier: BSD-3-Clause
#include "tests/accuracy/means.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace episcope::accuracy {
namespace {

Mean& mean_of(std::vector<Mean>& means, const std::string& group, const std::string& method) {
  const auto found = std::ranges::find_if(
      means, [&](const Mean& mean) { return mean.group == group && mean.method == method; });
  if (found != means.end()) return *found;
  Mean& added = means.emplace_back();
  added.group = group;
  added.method = method;
  return added;
}

// Sums, of logarithms for the geometric means.
void add(Mean& sum, const Measurement& measurement) {
  ++sum.scenes;
  sum.geometric_mse_100 += std::log(std::max(measurement.mse_100, kLeastMse));
  sum.geometric_mse_100_inset15 += std::log(std::max(measurement.mse_100_inset15, kLeastMse));
  sum.mse_100 += measurement.mse_100;
  sum.badpix_0070 += measurement.badpix_0070;
  sum.seconds += measurement.seconds;
}

void divide(Mean& sum) {
  const double share = 1.0 / sum.scenes;
  sum.geometric_mse_100 = std::exp(share * sum.geometric_mse_100);
  sum.geometric_mse_100_inset15 = std::exp(share * sum.geometric_mse_100_inset15);
  sum.mse_100 *= share;
  sum.badpix_0070 *= share;
  sum.seconds *= share;
}

}  // namespace

std::vector<Mean> means_of(const std::vector<Measurement>& measurements, const std::string& all) {
  std::vector<Mean> means;
  for (const Measurement& each : measurements) {
    add(mean_of(means, each.group, each.method), each);
  }
  for (const Measurement& each : measurements) add(mean_of(means, all, each.method), each);
  for (Mean& mean : means) divide(mean);
  return means;
}

std::string means_table(const std::vector<Mean>& means) {
  std::string table =
      "| set | method | scenes | MSE×100, geometric mean | inset 15, geometric mean | MSE×100, "
      "mean "
      "| BadPix(0.07) %, mean | seconds, mean |\n|---|---|---:|---:|---:|---:|---:|---:|\n";
  for (const Mean& mean : means) {
    table +=
        fmt::format("| {} | {} | {} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} |\n", mean.group,
                    mean.method, mean.scenes, mean.geometric_mse_100,
                    mean.geometric_mse_100_inset15, mean.mse_100, mean.badpix_0070, mean.seconds);
  }
  return table;
}

}  // namespace episcope::accuracy
