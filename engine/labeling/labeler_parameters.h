// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/schema.h"
#include "engine/labeling/rays/regularizer.h"

namespace episcope {

/// The features that the forest uses: the three sets of the archive. Which disparity is meant is up
/// to the caller; here all but Image judge labels by it.
enum class FeatureSet { Image, ImageEstimate, ImageTruth };
[[nodiscard]] Names<FeatureSet> names_of(FeatureSet);

/// Parameters of a segmentation.
struct LabelerParameters {
  FeatureSet features = FeatureSet::ImageEstimate;
  Regularizer regularizer = Regularizer::Rayspace;
  double smoothness = 32;
  double nearness = 0.35;
  int trees = 96;
  int depth = 14;
  int seed = 1;
};

[[nodiscard]] Schema<LabelerParameters> labeler_schema();

/// Whether the set of features includes disparity.
[[nodiscard]] bool uses_disparity(const LabelerParameters& parameters);

}  // namespace episcope
