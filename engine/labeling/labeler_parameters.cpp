// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/labeler_parameters.h"

namespace episcope {

Names<FeatureSet> names_of(FeatureSet) {
  return {{FeatureSet::Image, "image"},
          {FeatureSet::ImageEstimate, "image+estimate"},
          {FeatureSet::ImageTruth, "image+truth"}};
}

Schema<LabelerParameters> labeler_schema() {
  return Schema<LabelerParameters>()
      .choice("features", &LabelerParameters::features,
              {"Features",
               "Features that the forest uses: of the image alone, or of disparity as well"})
      .choice("regularizer", &LabelerParameters::regularizer,
              {"Smoothing",
               "How labels are made consistent: not at all, view by view, along the rays of all "
               "views (rayspace), or by minimising one energy of all views (wsg13; slower, 16 "
               "bytes per ray and label)"})
      .real("smoothness", &LabelerParameters::smoothness,
            {"Smoothness", "Cost of one pixel of boundary between labels, in units of -log p", ""},
            {0, 200})
      .real("nearness", &LabelerParameters::nearness,
            {"Nearness",
             "Influence of the distance to the strokes of a label, measured along surfaces"},
            {0, 5})
      .integer("trees", &LabelerParameters::trees, {"Trees", "Number of trees of the forest"},
               {4, 500})
      .integer("depth", &LabelerParameters::depth, {"Depth", "Maximum depth of a tree"}, {1, 25})
      .integer("seed", &LabelerParameters::seed,
               {"Seed", "Seed of the random numbers used to train the forest"}, {0, 1000000});
}

bool uses_disparity(const LabelerParameters& parameters) {
  return parameters.features != FeatureSet::Image;
}

}  // namespace episcope
