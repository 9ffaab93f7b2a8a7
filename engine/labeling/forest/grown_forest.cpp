// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/forest/grown_forest.h"

#include <algorithm>
#include <utility>

namespace episcope {

const Forest& GrownForest::train(ForestSamples samples, const ForestOptions& options, int enough,
                                 const Progress& progress) {
  if (samples != samples_ || options != options_) {
    progress.step(kTrainingStep);
    ForestOptions first = options;
    first.trees = std::min(enough, options.trees);
    forest_ = Forest::train(samples, first, progress);
    samples_ = std::move(samples);
    options_ = options;
  }
  return forest_;
}

bool GrownForest::complete(const Progress& progress) {
  if (forest_.tree_count() >= options_.trees) return false;
  progress.step(kTrainingStep);
  forest_.grow(samples_, options_, progress);
  return true;
}

}  // namespace episcope
