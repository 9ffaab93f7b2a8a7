// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/features/training_samples.h"

#include "engine/core/error.h"

#include <algorithm>
#include <set>
#include <string>

namespace episcope {
namespace {

void require_fit(const ViewScribbles& painted, const LightField& lf) {
  if (lf.grid().contains(painted.view) && painted.labels.height() == lf.height() &&
      painted.labels.width() == lf.width()) {
    return;
  }
  throw InvalidInput("scribbles of " + std::to_string(painted.labels.width()) + "×" +
                     std::to_string(painted.labels.height()) + " px on view " +
                     view_text(painted.view) + " do not fit the light field " + lf.info().name +
                     " of " + std::to_string(lf.grid().v) + "×" + std::to_string(lf.grid().u) +
                     " views of " + std::to_string(lf.width()) + "×" + std::to_string(lf.height()) +
                     " px");
}

}  // namespace

std::vector<std::int32_t> painted_labels(const Scribbles& scribbles, const LightField& lf) {
  std::set<std::int32_t> found;
  for (const ViewScribbles& painted : scribbles.views) {
    require_fit(painted, lf);
    std::int32_t last = 0;
    for (const std::int32_t label : painted.labels) {
      if (label != last && label > 0) found.insert(label);
      last = label;
    }
  }
  if (found.empty()) {
    throw InvalidInput("nothing is painted yet; paint strokes of at least two labels");
  }
  if (found.size() == 1) {
    throw InvalidInput("only label " + std::to_string(*found.begin()) +
                       " is painted; paint a second one as well");
  }
  return {found.begin(), found.end()};
}

void append_samples(const ViewScribbles& painted, VolumeView<const float> features,
                    const std::vector<std::int32_t>& ids, ForestSamples& samples) {
  for (int y = 0; y < features.height; ++y) {
    for (int x = 0; x < features.width; ++x) {
      const std::int32_t label = painted.labels.at(y, x);
      if (label <= 0) continue;
      const auto place = std::ranges::lower_bound(ids, label);
      samples.labels.push_back(static_cast<std::int32_t>(place - ids.begin()));
      for (int f = 0; f < features.layers; ++f) samples.features.push_back(features.at(y, f, x));
    }
  }
}

}  // namespace episcope
