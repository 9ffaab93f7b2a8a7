// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation/resolved_errors.h"

#include "engine/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace episcope {
namespace {

constexpr float kNoEstimate = std::numeric_limits<float>::quiet_NaN();

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

Image<float> marked(const DisparityView& map) {
  Image<float> result(map.disparity.height, map.disparity.width);
  for (int y = 0; y < result.height(); ++y) {
    for (int x = 0; x < result.width(); ++x) {
      result.at(y, x) = map.is_valid(y, x) ? map.disparity.at(y, x) : kNoEstimate;
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
    row[x] = has_value ? map[column] : kNoEstimate;
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
