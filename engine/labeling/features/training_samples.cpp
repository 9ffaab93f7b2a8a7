// SPDX-License-Identifier: BSD-3-Clause
#include "engine/labeling/features/training_samples.h"

#include "engine/core/error.h"

#include <fmt/format.h>

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
  throw InvalidInput(fmt::format(
      "scribbles of {}×{} px on view {} do not fit the light field {} of {}×{} views of {}×{} px",
      painted.labels.width(), painted.labels.height(), view_text(painted.view), lf.info().name,
      lf.grid().v, lf.grid().u, lf.width(), lf.height()));
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
    throw InvalidInput(
        fmt::format("only label {} is painted; paint a second one as well", *found.begin()));
  }
  return {found.begin(), found.end()};
}

void append_samples(const ViewScribbles& painted, VolumeView<const float> features,
                    const std::vector<std::int32_t>& ids, ForestSamples& samples) {
  samples.occasional = {kPlaceLayer, kPlaceLayer + 1};
  for (int layer = kDisparitySlopeLayer; layer < features.layers; ++layer) {
    samples.occasional.push_back(layer);
  }
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
