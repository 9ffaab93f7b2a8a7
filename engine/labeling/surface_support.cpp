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
void count_row(const float* votes, const float* misfits, int pitch, const float* trust, int width,
               std::vector<Counts>& counts) {
  const auto labels = static_cast<std::ptrdiff_t>(counts.size());
  for (int x = 0; x < width; ++x, votes += pitch, misfits += pitch) {
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
  const int pitch = pixel_votes.pitch();
  const auto labels = static_cast<std::size_t>(pixel_votes.label_count());
  const std::size_t row_size = static_cast<std::size_t>(pixel_votes.width()) * pitch;
  const int rows = (pixel_votes.height() + kRowStep - 1) / kRowStep;
  // Of each row by itself, so that the sums do not depend on the threads.
  std::vector<std::vector<Counts>> of_rows(static_cast<std::size_t>(rows));
  parallel_for_workers(rows, progress, [&] {
    return [&, votes = std::vector<float>(row_size),
            misfits = std::vector<float>(row_size)](int row) mutable {
      const int y = std::min(row * kRowStep + kRowStep / 2, pixel_votes.height() - 1);
      pixel_votes.row(y, votes.data());
      surfaces.misfits(y, pitch, misfits.data());
      std::vector<Counts>& counts = of_rows[static_cast<std::size_t>(row)];
      counts.assign(labels, {0, 0});
      count_row(votes.data(), misfits.data(), pitch, trust.row(y), pixel_votes.width(), counts);
    };
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
