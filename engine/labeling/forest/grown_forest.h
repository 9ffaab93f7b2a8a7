// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/labeling/forest/forest.h"

namespace episcope {

/// A forest and what it was trained on, kept while it would be the same.
class GrownForest {
 public:
  /// As reported by `progress` while trees are trained.
  static constexpr const char* kTrainingStep = "training the forest";

  /// The forest for these samples, trained only if it would differ from the last one: `enough`
  /// trees of it at least. Valid until the next call. Throws as Forest::train.
  const Forest& train(ForestSamples samples, const ForestOptions& options, int enough,
                      const Progress& progress);
  /// Trains what is missing to all trees. Whether any were. Throws Cancelled.
  bool complete(const Progress& progress);

 private:
  ForestSamples samples_;
  ForestOptions options_;
  Forest forest_;
};

}  // namespace episcope
