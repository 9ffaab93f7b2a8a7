// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/metrics/part_score.h"

#include "engine/evaluation/metrics/nth_value.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace episcope {
namespace {

/// Calls `visit(pixel)` for the judged pixels of a part.
template <class Visit>
void visit_part(const Evaluation& evaluation, const Image<std::uint8_t>* part, Visit visit) {
  for (std::size_t i = 0; i < evaluation.judged.size(); ++i) {
    if (evaluation.judged.data()[i] != 0 && (!part || part->data()[i] != 0)) visit(i);
  }
}

struct Limit {
  const char* key;
  float error_px;
};
constexpr Limit kLimits[] = {
    {"badpix_0010", 0.01F}, {"badpix_0030", 0.03F}, {"badpix_0070", 0.07F}};

struct Sums {
  std::size_t pixels = 0;
  std::size_t missing = 0;
  double squares = 0;
  std::size_t bad[std::size(kLimits)] = {};
};

Sums sums_of(const Evaluation& evaluation, const Image<std::uint8_t>* part) {
  Sums sums;
  visit_part(evaluation, part, [&](std::size_t i) {
    const float error = evaluation.signed_error.data()[i];
    const bool is_missing = evaluation.missing.data()[i] != 0;
    ++sums.pixels;
    sums.missing += is_missing ? 1 : 0;
    sums.squares += double{error} * error;
    for (std::size_t limit = 0; limit < std::size(kLimits); ++limit) {
      sums.bad[limit] += is_missing || std::abs(error) > kLimits[limit].error_px ? 1 : 0;
    }
  });
  return sums;
}

// Missing ones are last in the order.
double q_25_100(const Evaluation& evaluation, const Image<std::uint8_t>* part, const Sums& sums) {
  const std::size_t rank = sums.pixels * 25 / 100;
  const std::size_t present = sums.pixels - sums.missing;
  const bool is_missing = rank >= present;
  const auto feed = [&](const auto& sink) {
    visit_part(evaluation, part, [&](std::size_t i) {
      if ((evaluation.missing.data()[i] != 0) != is_missing) return;
      sink(std::abs(evaluation.signed_error.data()[i]) * 100);
    });
  };
  return double{nth_value(feed, is_missing ? rank - present : rank)};
}

Interval judged_disparities(const Evaluation& evaluation, const Image<float>& truth,
                            const Image<std::uint8_t>* part) {
  Interval range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  visit_part(evaluation, part, [&](std::size_t i) {
    range.min = std::min(range.min, double{truth.data()[i]});
    range.max = std::max(range.max, double{truth.data()[i]});
  });
  return range;
}

}  // namespace

PartScore score_part(const Evaluation& evaluation, const Image<std::uint8_t>* part,
                     Protocol protocol) {
  const Sums sums = sums_of(evaluation, part);
  PartScore score{sums.pixels, {}};
  if (sums.pixels == 0) return score;
  const auto count = static_cast<double>(sums.pixels);
  score.metrics.emplace_back("mse_100", 100 * sums.squares / count);
  if (protocol == Protocol::Benchmark2016) {
    for (std::size_t limit = 0; limit < std::size(kLimits); ++limit) {
      score.metrics.emplace_back(kLimits[limit].key,
                                 100 * static_cast<double>(sums.bad[limit]) / count);
    }
    score.metrics.emplace_back("q_25_100", q_25_100(evaluation, part, sums));
  }
  score.metrics.emplace_back("density", 100 - 100 * static_cast<double>(sums.missing) / count);
  return score;
}

std::vector<ErrorBin> errors_by_disparity(const Evaluation& evaluation, const DisparityView& truth,
                                          const Image<std::uint8_t>* part, int bins,
                                          double bad_threshold_px) {
  Image<float> disparity(truth.disparity.height, truth.disparity.width);
  for (int y = 0; y < disparity.height(); ++y) {
    std::copy_n(truth.disparity.row(y), disparity.width(), disparity.row(y));
  }
  const Interval range = judged_disparities(evaluation, disparity, part);
  if (!(range.max >= range.min)) return {};
  if (range.max == range.min) bins = 1;
  const double width = (range.max - range.min) / bins;
  std::vector<ErrorBin> profile(static_cast<std::size_t>(bins));
  for (int bin = 0; bin < bins; ++bin) {
    profile[static_cast<std::size_t>(bin)].disparity = {range.min + bin * width,
                                                        range.min + (bin + 1) * width};
  }
  visit_part(evaluation, part, [&](std::size_t i) {
    const double place = width > 0 ? (double{disparity.data()[i]} - range.min) / width : 0;
    ErrorBin& bin =
        profile[static_cast<std::size_t>(std::clamp(static_cast<int>(place), 0, bins - 1))];
    const float error = evaluation.signed_error.data()[i];
    const bool is_bad =
        evaluation.missing.data()[i] != 0 || std::abs(error) > static_cast<float>(bad_threshold_px);
    ++bin.pixels;
    bin.mse_100 += double{error} * error;
    bin.bad_percent += is_bad ? 1 : 0;
  });
  std::erase_if(profile, [](const ErrorBin& bin) { return bin.pixels == 0; });
  for (ErrorBin& bin : profile) {
    bin.mse_100 *= 100 / static_cast<double>(bin.pixels);
    bin.bad_percent *= 100 / static_cast<double>(bin.pixels);
  }
  return profile;
}

}  // namespace episcope
