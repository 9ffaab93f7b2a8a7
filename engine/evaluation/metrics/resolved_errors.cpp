// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/resolved_errors.h"

#include "engine/core/error.h"
#include "engine/evaluation/metrics/nth_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace episcope {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// The nearest of `count` samples for each of `scale`·`count`, corners on corners. No pixel is
/// equally near to two: the doubled distances have an odd denominator.
std::vector<int> nearest_samples(int count, int scale) {
  const std::int64_t last = std::int64_t{count} * scale - 1;
  std::vector<int> nearest(static_cast<std::size_t>(last) + 1, 0);
  for (std::int64_t k = 0; last > 0 && k <= last; ++k) {
    nearest[static_cast<std::size_t>(k)] =
        static_cast<int>((2 * k * (count - 1) + last) / (2 * last));
  }
  return nearest;
}

}  // namespace

Image<float> marked(const DisparityView& map) {
  Image<float> result(map.disparity.height, map.disparity.width);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      result.at(y, x) = map.is_valid(y, x) ? map.disparity.at(y, x) : kNan;
    }
  }
  return result;
}

ResolvedErrors::ResolvedErrors(const DisparityView& estimate, ImageView<const float> truth,
                               int scale, const EvaluationOptions& options)
    : estimate_(estimate),
      truth_(truth),
      scale_(scale),
      options_(options),
      invalid_(options.invalid),
      rows_(nearest_samples(estimate.disparity.height, scale)),
      columns_(nearest_samples(estimate.disparity.width, scale)) {
  const auto& map = estimate.disparity;
  if (truth.height != map.height * scale || truth.width != map.width * scale) {
    throw InvalidInput(
        fmt::format("the truth has {}×{} px, but {} times the {}×{} px of the map "
                    "are expected",
                    truth.width, truth.height, scale, map.width, map.height));
  }
  if (invalid_ == InvalidEstimates::Compatible) return;
  farthest_ = std::numeric_limits<float>::infinity();
  visit(nullptr, 0, [&](int y, int x, float) { farthest_ = std::min(farthest_, truth_.at(y, x)); });
}

void ResolvedErrors::sample_row(int y, std::vector<float>& row) const {
  row.resize(columns_.size());
  const int from = rows_[y];
  const float* map = estimate_.disparity.row(from);
  const std::uint8_t* valid = estimate_.valid.empty() ? nullptr : estimate_.valid.row(from);
  for (std::size_t x = 0; x < row.size(); ++x) {
    const int column = columns_[x];
    const bool has_value = (!valid || valid[column] != 0) && std::isfinite(map[column]);
    row[x] = has_value ? map[column] : kNan;
  }
}

std::optional<double> ResolvedErrors::mse_100(const Image<std::uint8_t>* mask, int border) const {
  double sum = 0;
  std::size_t count = 0;
  visit(mask, border, [&](int y, int x, float estimate) {
    if (std::isnan(estimate)) {
      if (invalid_ == InvalidEstimates::Compatible) return;
      estimate = farthest_;
    }
    const double error = truth_.at(y, x) - estimate;
    sum += error * error;
    ++count;
  });
  if (count == 0) return std::nullopt;
  return 100 * sum / static_cast<double>(count);
}

std::optional<double> ResolvedErrors::q_25_100(int border) const {
  const auto feed = [&](bool missing) {
    return [this, missing, border](const auto& sink) {
      visit(nullptr, border, [&](int y, int x, float estimate) {
        if (std::isnan(estimate) != missing) return;
        sink(std::abs(truth_.at(y, x) - (missing ? farthest_ : estimate)) * 100);
      });
    };
  };
  std::size_t present = 0, missing = 0;
  visit(nullptr, border,
        [&](int, int, float estimate) { ++(std::isnan(estimate) ? missing : present); });
  if (invalid_ == InvalidEstimates::Compatible) missing = 0;
  if (present + missing == 0) return std::nullopt;
  const std::size_t rank = (present + missing) * 25 / 100;
  // Missing ones are last in the order.
  return rank < present ? nth_value(feed(false), rank) : nth_value(feed(true), rank - present);
}

Metrics ResolvedErrors::general(int border) const {
  Metrics metrics;
  const auto append = [&](const char* key, std::optional<double> value) {
    if (value) metrics.emplace_back(key, *value);
  };
  append("mse_100", mse_100(nullptr, border));
  constexpr std::pair<const char*, float> limits[] = {
      {"badpix_0010", 0.01F}, {"badpix_0030", 0.03F}, {"badpix_0070", 0.07F}};
  std::size_t count = 0, bad[std::size(limits)] = {};
  visit(nullptr, border, [&](int y, int x, float estimate) {
    ++count;
    for (std::size_t i = 0; i < std::size(limits); ++i) {
      bad[i] += is_off(y, x, estimate, limits[i].second) ? 1 : 0;
    }
  });
  for (std::size_t i = 0; i < std::size(limits) && count > 0; ++i) {
    append(limits[i].first, 100.0 * static_cast<double>(bad[i]) / static_cast<double>(count));
  }
  append("q_25_100", q_25_100(border));
  return metrics;
}

}  // namespace episcope
