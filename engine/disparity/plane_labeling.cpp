// SPDX-License-Identifier: BSD-3-Clause
#include "engine/disparity/plane_labeling.h"

#include "engine/core/image.h"
#include "engine/core/parallel.h"
#include "engine/cuda/layer_solver.h"
#include "engine/cuda/tv_l2.h"
#include "engine/solvers/layered_sweep.h"
#include "engine/solvers/message_labeling.h"
#include "engine/solvers/tv_l2.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

namespace episcope {
namespace {

float color_step(const Image<float>& image, PixelIndex a, PixelIndex b) {
  float sum = 0;
  for (int c = 0; c < image.channels(); ++c) {
    const float off = image.at(a.y, a.x, c) - image.at(b.y, b.x, c);
    sum += off * off;
  }
  return std::sqrt(sum);
}

MessageResult solve_jumps(const LabelCosts& costs, const MessageProblem& problem, int passes,
                          const Progress& progress) {
  if (!costs.on_device()) return solve_by_messages(problem, passes, progress);
  cuda::MessageAnswer answer = cuda::solve_by_messages(
      {*costs.on_device(), problem.across, problem.down, problem.slope, problem.most}, passes,
      progress);
  return {std::move(answer.labels), answer.iterations, answer.energy, answer.bound};
}

// λ of the denoising of single pixels, as in ST_AV_S, and the weight above which those that are
// trusted count more than in proportion.
constexpr double kWinnerSmoothing = 0.1;
constexpr float kSureWeight = 0.12F;

float label_step(const StereoCosts& stereo) {
  return stereo.labels[1] - stereo.labels[0];
}

// What the costs around each disparity say, and how much.
Placements observe(const PlaneRefinementData& data, ImageView<const float> disparity,
                   const Progress& progress) {
  const StereoCosts& stereo = data.costs.stereo();
  const float step = label_step(stereo), first = stereo.labels.front();
  const int last = static_cast<int>(stereo.labels.size()) - 1;
  Image<int> labels(disparity.height, disparity.width);
  parallel_for(disparity.height, progress.part(0, 0.2), [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      const float place = (disparity.at(y, x) - first) / step;
      labels.at(y, x) = std::clamp(static_cast<int>(place + 0.5F), 0, last);
    }
  });
  return data.costs.place(labels, progress.part(0.2, 1));
}

// The best label of every pixel by itself, placed between labels and denoised by its trust.
Image<float> denoised_winners(const PlaneRefinementData& data, const Progress& progress) {
  Placements all =
      data.costs.place(data.costs.best_labels(progress.part(0, 0.15)), progress.part(0.15, 0.3));
  for (float& weight : all.weight) weight *= 1 + weight / kSureWeight;
  const Progress solving = progress.part(0.3, 1);
  if (data.costs.on_device()) {
    cuda::solve_tv_l2(all.disparity, all.weight, data.edges, kWinnerSmoothing, solving);
  } else {
    TvL2Solver(all.disparity.height(), all.disparity.width())
        .solve({all.disparity, all.weight, data.edges, kWinnerSmoothing}, {}, solving,
               all.disparity.view());
  }
  return std::move(all.disparity);
}

// Where costs hardly tell labels apart, a labeling settles for whole regions of one wrong label,
// and for silhouettes that are a little too wide; the mean of what the pixels say by themselves is
// then nearer to the truth, but coarser where both agree.
void settle_doubt(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                  const Progress& progress, ImageView<float> disparity) {
  const Image<float> trust = regional_trust(
      data.costs.confidence(disparity, progress.part(0, 0.1)).view(data.costs.stereo().view));
  const Image<float> denoised = denoised_winners(data, progress.part(0.1, 1));
  const auto doubt = static_cast<float>(parameters.doubt);
  const auto leeway = static_cast<float>(std::max(parameters.leeway, 1e-6));
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      const float other = denoised.at(y, x);
      const float trusted = std::clamp((trust.at(y, x) / doubt - 1) * 2, 0.0F, 1.0F);
      const float agreed = std::clamp(2 - std::abs(d - other) / leeway, 0.0F, 1.0F);
      d = other + std::max(trusted, agreed) * (d - other);
    }
  }
}

constexpr int kMedianRadius = 4;
constexpr int kBand = 3;
constexpr float kJump_px = 0.2F;
// σ of colors, as a share of their spread, and at most, in three channels.
constexpr double kShareOfSpread = 0.25;
constexpr double kMostSigma = 0.08;
constexpr double kLeastSigma = 1e-3;
constexpr float kPlaceSigma_px = 1.7F;
constexpr int kSide = 2 * kMedianRadius + 1;

// Marks what is within kBand of a jump, square by square.
Image<std::uint8_t> near_jumps(ImageView<const float> disparity) {
  const int height = disparity.height, width = disparity.width;
  Image<std::uint8_t> near(height, width);
  const auto mark = [&](int y, int x) {
    for (int row = std::max(0, y - kBand); row <= std::min(height - 1, y + kBand); ++row) {
      const int first = std::max(0, x - kBand), last = std::min(width - 1, x + kBand);
      std::fill(near.row(row) + first, near.row(row) + last + 1, std::uint8_t{1});
    }
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float d = disparity.at(y, x);
      const bool jumps = (x + 1 < width && std::abs(disparity.at(y, x + 1) - d) > kJump_px) ||
                         (y + 1 < height && std::abs(disparity.at(y + 1, x) - d) > kJump_px);
      if (jumps) mark(y, x);
    }
  }
  return near;
}

// exp(−r²/2ρ²) of the window, row by row.
std::array<float, kSide * kSide> place_weights() {
  std::array<float, kSide * kSide> weights{};
  for (int y = -kMedianRadius; y <= kMedianRadius; ++y) {
    for (int x = -kMedianRadius; x <= kMedianRadius; ++x) {
      weights[(y + kMedianRadius) * kSide + x + kMedianRadius] =
          std::exp(-static_cast<float>(y * y + x * x) / (2 * kPlaceSigma_px * kPlaceSigma_px));
    }
  }
  return weights;
}

// Root of the variances of the channels, summed.
double spread_of_samples(const Image<float>& samples) {
  double variance = 0;
  const int channels = samples.channels();
  const double count = static_cast<double>(samples.size()) / channels;
  for (int c = 0; c < channels; ++c) {
    double sum = 0, squares = 0;
    const float* const end = samples.data() + samples.size();
    for (const float* at = samples.data() + c; at < end; at += channels) {
      sum += *at;
      squares += static_cast<double>(*at) * *at;
    }
    variance += std::max(0.0, squares / count - sum * sum / (count * count));
  }
  return std::sqrt(variance);
}

// A value of the window and its weight.
using Vote = std::pair<float, float>;

float weighted_median(std::array<Vote, kSide * kSide>& votes, int count) {
  std::sort(votes.begin(), votes.begin() + count);
  float sum = 0, before = 0;
  for (int i = 0; i < count; ++i) sum += votes[i].second;
  for (int i = 0; i < count; ++i) {
    before += votes[i].second;
    if (before >= sum / 2) return votes[i].first;
  }
  return votes[count - 1].first;
}

class PlacedSilhouettes {
 public:
  PlacedSilhouettes(const LightField& lf, ViewIndex view, ImageView<const float> disparity)
      : lf_(lf),
        view_(view),
        disparity_(disparity),
        samples_(lf.view_as_float(view)),
        places_(place_weights()) {
    const double channels = channel_weight(lf.channels());
    const double sigma =
        std::clamp(kShareOfSpread * std::sqrt(channels) * spread_of_samples(samples_), kLeastSigma,
                   kMostSigma);
    strength_ = static_cast<float>(-channels / (2 * sigma * sigma));
  }

  [[nodiscard]] float median(int y, int x) const {
    std::array<Vote, kSide * kSide> votes;
    int count = 0;
    const int last_row = std::min(lf_.height() - 1, y + kMedianRadius);
    const int last_column = std::min(lf_.width() - 1, x + kMedianRadius);
    for (int row = std::max(0, y - kMedianRadius); row <= last_row; ++row) {
      for (int column = std::max(0, x - kMedianRadius); column <= last_column; ++column) {
        if (!lf_.is_valid(view_, row, column)) continue;
        const int place = (row - y + kMedianRadius) * kSide + column - x + kMedianRadius;
        votes[count++] = {disparity_.at(row, column), places_[place] * likeness(y, x, row, column)};
      }
    }
    return weighted_median(votes, count);
  }

 private:
  [[nodiscard]] float likeness(int y, int x, int row, int column) const {
    const int channels = lf_.channels();
    const float* const one = samples_.row(y) + static_cast<std::ptrdiff_t>(x) * channels;
    const float* const other = samples_.row(row) + static_cast<std::ptrdiff_t>(column) * channels;
    float square = 0;
    for (int c = 0; c < channels; ++c) square += (one[c] - other[c]) * (one[c] - other[c]);
    return std::exp(strength_ * square);
  }

  const LightField& lf_;
  ViewIndex view_;
  ImageView<const float> disparity_;
  Image<float> samples_;
  std::array<float, kSide * kSide> places_;
  float strength_ = 0;  // −1/2σ²
};

}  // namespace

Schema<JumpLabelingParameters> jump_labeling_schema() {
  using P = JumpLabelingParameters;
  return Schema<P>()
      .real("smoothness", &P::smoothness,
            {"Smoothness λ", "Cost of a px by which neighbors differ, relative to the cap"},
            {0.001, 100, true})
      .real("jump", &P::jump,
            {"Maximum jump", "No pair of neighbors pays for a larger difference than this", "px"},
            {0.001, 20})
      .real("edge_strength", &P::edge_strength,
            {"Edge strength β",
             "A pair of neighbors is weighted by exp(−β·|difference of their colors|)"},
            {0, 100})
      .real("least_weight", &P::least_weight,
            {"Minimum neighbor weight", "The smallest weight of a pair of neighbors"}, {0, 1})
      .integer("passes", &P::passes, {"Iterations", "Iterations of the labeling"}, {1, 200, true});
}

PairWeights pair_weights(const LightField& lf, ViewIndex view, double beta, double least,
                         const Progress& progress) {
  const Image<float> image = lf.view_as_float(view);
  PairWeights weights{Image<float>(lf.height(), lf.width(), 1, 1.0F),
                      Image<float>(lf.height(), lf.width(), 1, 1.0F)};
  const double strength = beta * std::sqrt(channel_weight(lf.channels()));
  const auto weight = [&](PixelIndex a, PixelIndex b) {
    return static_cast<float>(std::max(least, std::exp(-strength * color_step(image, a, b))));
  };
  parallel_for(lf.height(), progress, [&](int y) {
    for (int x = 0; x < lf.width(); ++x) {
      if (x + 1 < lf.width()) weights.across.at(y, x) = weight({y, x}, {y, x + 1});
      if (y + 1 < lf.height()) weights.down.at(y, x) = weight({y, x}, {y + 1, x});
    }
  });
  return weights;
}

std::string label_with_jumps(const PlaneRefinementData& data, const PairWeights& weights,
                             const JumpLabelingParameters& parameters, const Progress& progress,
                             ImageView<float> disparity) {
  progress.step("labeling");
  const std::vector<float>& labels = data.costs.stereo().labels;
  const float step = labels[1] - labels[0];
  const auto unit = static_cast<float>(parameters.smoothness * data.scale);
  const MessageProblem problem{data.costs.on_cpu(), weights.across, weights.down, unit * step,
                               unit * static_cast<float>(parameters.jump)};
  const MessageResult result =
      solve_jumps(data.costs, problem, parameters.passes, progress.part(0, 0.95));
  const Placements placed = data.costs.place(result.labels, progress.part(0.95, 1));
  for (int y = 0; y < disparity.height; ++y) {
    std::copy_n(placed.disparity.row(y), disparity.width, disparity.row(y));
  }
  return fmt::format("labeling: energy {:.6g}, gap {:.1e} after {} iterations", result.energy,
                     labeling_gap(result.energy, result.bound), result.iterations);
}

Schema<PlaneRefinementParameters> plane_refinement_schema() {
  using P = PlaneRefinementParameters;
  return Schema<P>()
      .real("tgv", &P::tgv,
            {"Final denoising", "Strength of the final denoising with TGV²; 0 = off"}, {0, 10})
      .real("doubt", &P::doubt,
            {"Uncertain below",
             "Regions whose mean confidence is below this are uncertain: denoising places their "
             "pixels by what each says by itself, if that is elsewhere; 0 = none"},
            {0, 1})
      .real("leeway", &P::leeway,
            {"Uncertain: tolerance",
             "Uncertain pixels keep their label where denoising moves them by no more than this",
             "px"},
            {0, 20})
      .real("bend", &P::bend,
            {"Curvature cost", "Relative cost of curvature to jumps in the final denoising", "px"},
            {0.01, 100, true})
      .integer("tgv_iterations", &P::tgv_iterations,
               {"Denoising iterations", "Number of iterations of the final denoising"},
               {1, 5000, true});
}

void refine_by_planes(const PlaneRefinementData& data, const PlaneRefinementParameters& parameters,
                      const Progress& progress, ImageView<float> disparity) {
  if (parameters.tgv <= 0 || progress.finish_requested()) return;
  progress.step("denoising");
  Placements seen = observe(data, disparity, progress.part(0, 0.1));
  const Progress solving = progress.part(0.1, 0.9);
  if (data.costs.on_device()) {
    cuda::solve_tgv_l2(seen.disparity, {seen.weight, data.edges, parameters.tgv, parameters.bend},
                       parameters.tgv_iterations, solving);
  } else {
    solve_tgv_l2({seen.disparity, seen.weight, data.edges, parameters.tgv, parameters.bend},
                 parameters.tgv_iterations, solving, seen.disparity.view());
  }
  const float step = label_step(data.costs.stereo());
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      float& d = disparity.at(y, x);
      d = std::clamp(seen.disparity.at(y, x), d - step, d + step);
    }
  }
  if (parameters.doubt > 0) settle_doubt(data, parameters, progress.part(0.9, 1), disparity);
}

void place_silhouettes(const LightField& lf, ViewIndex view, const Progress& progress,
                       ImageView<float> disparity) {
  const Image<std::uint8_t> near = near_jumps(disparity);
  Image<float> before(disparity.height, disparity.width);
  for (int y = 0; y < disparity.height; ++y) {
    std::copy_n(disparity.row(y), disparity.width, before.row(y));
  }
  const PlacedSilhouettes silhouettes(lf, view, before);
  parallel_for(disparity.height, progress, [&](int y) {
    for (int x = 0; x < disparity.width; ++x) {
      if (near.at(y, x) == 0 || !lf.is_valid(view, y, x)) continue;
      disparity.at(y, x) = silhouettes.median(y, x);
    }
  });
}

}  // namespace episcope
