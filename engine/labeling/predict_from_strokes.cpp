// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/predict_from_strokes.h"

#include "engine/labeling/features/label_surfaces.h"
#include "engine/labeling/features/pixel_features.h"
#include "engine/labeling/features/stroke_distance.h"
#include "engine/labeling/predict_view.h"
#include "engine/labeling/rays/disparity_trust.h"
#include "engine/labeling/surface_support.h"
#include "engine/labeling/thin_gaps.h"

#include <algorithm>
#include <optional>

namespace episcope {
namespace {

/// Edges of colour that a path along a surface should not cross.
std::vector<Image<float>> color_guides(VolumeView<const float> features) {
  std::vector<Image<float>> planes;
  for (int c = 0; c < 3; ++c) {
    Image<float>& plane = planes.emplace_back(features.height, features.width);
    for (int y = 0; y < features.height; ++y) {
      std::copy_n(features.row(y, kWiderSurfaceLayer + c), features.width, plane.row(y));
    }
  }
  return planes;
}

bool is_painted(const Scribbles& scribbles, ViewIndex view) {
  return std::ranges::find(scribbles.views, view, &ViewScribbles::view) != scribbles.views.end();
}

}  // namespace

ProbabilityMap predict_from_strokes(const StrokeKnowledge& known, ViewIndex view,
                                    VolumeView<const float> features, const PixelVotes& votes,
                                    const Progress& progress) {
  const int labels = votes.label_count();
  const Image<std::int32_t> strokes = carried_strokes(known.scribbles, known.ids, known.disparity,
                                                      view, features.height, features.width);
  const std::vector<Image<float>> colors = color_guides(features);
  StrokeGuides guides{{colors.begin(), colors.end()}};
  Image<float> filled, trust;
  std::optional<LabelSurfaces> surfaces;
  if (known.judges_disparity) {
    filled = filled_disparity(known.disparity->view(view));
    guides.disparity = filled.view();
    if (known.confidence != nullptr && known.confidence->contains(view)) {
      trust = disparity_trust(known.confidence->view(view));
    }
    guides.trust = trust.view();
    surfaces.emplace(strokes.view(), labels, filled.view(), guides.trust, progress);
    if (!trust.empty()) {
      surfaces->set_gaps(labels_in_thin_gaps(votes, *surfaces, progress).view());
      surfaces->set_support(surface_support(votes, *surfaces, trust, progress), progress);
    }
    guides.surfaces = &*surfaces;
  }
  const StrokeDistances distances(strokes, labels, guides, progress);
  StrokeEvidence evidence{distances, known.nearness, guides.surfaces};
  if (is_painted(known.scribbles, view)) evidence.painted = strokes.view();
  return predict_view(votes, evidence, progress);
}

}  // namespace episcope
