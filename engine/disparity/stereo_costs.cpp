// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/stereo_costs.h"

#include "engine/core/parallel.h"
#include "engine/core/quantile.h"
#include "engine/disparity/disparity_range.h"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace episcope {
namespace {

// Rows in which the residual is measured.
constexpr int kProbedRows = 24;
// ε in residuals, and the least: below it the steps of 8-bit samples are cut off.
constexpr double kCapInResiduals = 2;
constexpr double kLeastCap = 0.015;
// Of the guided filter, variance of samples in [0, 1].
constexpr double kRegularization = 1e-3;

// The residual of prepare_stereo. The cross-hair tells as much of noise as all views.
double residual(const LightField& lf, const StereoCosts& costs, const Progress& progress) {
  const MatchingCost probe{MatchedViews::CrossHair, costs.matching.interpolation, kUncapped};
  const int rows = std::min(kProbedRows, lf.height());
  std::vector<float> least(static_cast<std::size_t>(rows) * lf.width());
  parallel_for_workers(rows, progress, [&]() -> std::function<void(int)> {
    auto matching = std::make_shared<MatchingCostRows>(lf, costs.view, probe, costs.labels);
    auto row =
        std::make_shared<Volume<float>>(1, static_cast<int>(costs.labels.size()), lf.width());
    return [&, matching, row](int i) {
      matching->compute((2 * i + 1) * lf.height() / (2 * rows), row->view(), progress);
      float* out = least.data() + static_cast<std::size_t>(i) * lf.width();
      std::fill_n(out, lf.width(), static_cast<float>(kUncapped));
      for (int label = 0; label < row->layers(); ++label) {
        const float* cost = row->view().row(0, label);
        for (int x = 0; x < lf.width(); ++x) out[x] = std::min(out[x], cost[x]);
      }
    };
  });
  return quantile(least, 0.5);
}

}  // namespace

void apply_cost_profile(StereoCostParameters& parameters, double cap) {
  if (parameters.profile != "paper") return;
  parameters.epsilon = cap;
  parameters.interpolation = "bilinear";
  parameters.aggregation = 0;
}

StereoCosts prepare_stereo(const LightField& lf, MatchedViews views,
                           const StereoCostParameters& parameters, const Progress& progress) {
  StereoCosts costs;
  costs.view = parameters.view.value_or(lf.center());
  check_matching(lf, costs.view);
  costs.range = search_range(lf, parameters.range, progress.part(0, 0.5));
  costs.labels = equidistant_labels(costs.range, parameters.labels);
  costs.matching.views = views;
  costs.matching.interpolation =
      parameters.interpolation == "cubic" ? Interpolation::Cubic : Interpolation::Bilinear;
  costs.matching.cap = parameters.epsilon;
  if (parameters.epsilon == 0) {
    progress.step("noise");
    const double noise = residual(lf, costs, progress.part(0.5, 0.9));
    costs.matching.cap = std::clamp(kCapInResiduals * noise, kLeastCap, kUncapped);
  }
  if (parameters.aggregation > 0) {
    costs.guide = std::make_shared<GuideImage>(lf, costs.view, parameters.aggregation,
                                               kRegularization, progress.part(0.9, 1));
  }
  return costs;
}

StereoCostRows::StereoCostRows(const LightField& lf, const StereoCosts& costs)
    : costs_(costs),
      height_(lf.height()),
      width_(lf.width()),
      matching_(lf, costs.view, costs.matching, costs.labels),
      filter_(costs.guide ? std::make_unique<GuidedFilter>(*costs.guide) : nullptr) {}

VolumeView<const float> StereoCostRows::compute(int y, int rows, const Progress& progress) {
  const int reach = costs_.guide ? 2 * costs_.guide->radius() : 0;
  const int first = std::max(0, y - reach);
  const int last = std::min(height_, y + rows + reach);
  if (band_.height() < last - first) {
    band_ = Volume<float>(last - first, static_cast<int>(costs_.labels.size()), width_);
  }
  VolumeView<float> band = band_.view();
  band.height = last - first;
  matching_.compute(first, band, progress);
  if (filter_) filter_->apply(first, band, progress);
  band.data = band.row(y - first, 0);
  band.height = rows;
  return band;
}

int stereo_band_rows(int height) {
  return std::clamp(height / 12, 16, 64);
}

Volume<float> stereo_volume(const LightField& lf, const StereoCosts& costs,
                            const Progress& progress) {
  Volume<float> volume(lf.height(), static_cast<int>(costs.labels.size()), lf.width());
  const VolumeView<float> all = volume.view();
  const int rows = stereo_band_rows(lf.height());
  parallel_for_workers(
      (lf.height() + rows - 1) / rows, progress, [&]() -> std::function<void(int)> {
        auto source = std::make_shared<StereoCostRows>(lf, costs);
        return [&, source](int i) {
          const int y = i * rows;
          const auto band = source->compute(y, std::min(rows, lf.height() - y), progress);
          std::copy_n(band.data, band.size(), all.row(y, 0));
        };
      });
  return volume;
}

std::string cap_note(const StereoCosts& costs) {
  if (costs.matching.cap >= kUncapped) return "matching cost uncapped";
  char text[60];
  std::snprintf(text, sizeof text, "matching cost capped at ε = %.3f", costs.matching.cap);
  return text;
}

}  // namespace episcope
