// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/surface_support.h"

#include "engine/core/parallel/parallel.h"

#include <algorithm>
#include <cmath>

namespace episcope {
namespace {

constexpr int kRowStep = 8;
constexpr float kSureShare = 0.7F;
constexpr double kPrior = 3;

struct Counts {
  double fitting = kPrior, all = kPrior;
};

// Adds the pixels of a row of which the forest is sure.
void count_row(const PixelVotes& pixel_votes, const LabelSurfaces& surfaces, int y,
               const float* trust, std::vector<Counts>& counts) {
  const auto labels = static_cast<std::ptrdiff_t>(counts.size());
  const float *votes = pixel_votes.row(y), *misfits = surfaces.misfits(y);
  for (int x = 0; x < pixel_votes.width();
       ++x, votes += pixel_votes.pitch(), misfits += surfaces.pitch()) {
    const auto label = std::max_element(votes, votes + labels) - votes;
    if (votes[label] < kSureShare) continue;
    const float least = *std::min_element(misfits, misfits + labels);
    const auto weight = static_cast<double>(trust[x]);
    Counts& count = counts[static_cast<std::size_t>(label)];
    count.fitting += weight * std::exp(static_cast<double>(least - misfits[label]));
    count.all += weight;
  }
}

}  // namespace

std::vector<float> surface_support(const PixelVotes& pixel_votes, const LabelSurfaces& surfaces,
                                   ImageView<const float> trust, const Progress& progress) {
  const auto labels = static_cast<std::size_t>(pixel_votes.label_count());
  const int rows = (pixel_votes.height() + kRowStep - 1) / kRowStep;
  // Of each row by itself, so that the sums do not depend on the threads.
  std::vector<std::vector<Counts>> of_rows(static_cast<std::size_t>(rows));
  parallel_for(rows, progress, [&](int row) {
    const int y = std::min(row * kRowStep + kRowStep / 2, pixel_votes.height() - 1);
    std::vector<Counts>& counts = of_rows[static_cast<std::size_t>(row)];
    counts.assign(labels, {0, 0});
    count_row(pixel_votes, surfaces, y, trust.row(y), counts);
  });
  std::vector<float> support;
  for (std::size_t l = 0; l < labels; ++l) {
    Counts sum;
    for (const std::vector<Counts>& counts : of_rows) {
      sum.fitting += counts[l].fitting;
      sum.all += counts[l].all;
    }
    support.push_back(static_cast<float>(sum.fitting / sum.all));
  }
  return support;
}

}  // namespace episcope
