// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/segmentation_map.h"

#include "engine/evaluation/metrics/error_maps.h"
#include "engine/labeling/rays/boundary_weights.h"
#include "engine/labeling/rays/edge_probability.h"

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;

Image<float> probability_of(int label, VolumeView<const std::uint8_t> map,
                            const std::vector<std::int32_t>& ids) {
  const auto layer = static_cast<int>(std::ranges::find(ids, label) - ids.begin());
  Image<float> result(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    const std::uint8_t* row = map.row(y, layer);
    std::transform(row, row + map.width, result.row(y),
                   [](std::uint8_t byte) { return static_cast<float>(byte) / 255; });
  }
  return result;
}

// Those that boundaries between labels go by: of a file, else of the image and, if it is known, the
// disparity.
Image<float> edges_of(const MapSource& source) {
  if (source.edges) return larger_edge_probability(source.edges->view(source.view));
  const DisparityField none;
  return edge_probability(*source.light_field, source.view,
                          source.edge_disparity ? *source.edge_disparity : none, {});
}

void fill_wrong(ImageView<const std::int32_t> labels, ImageView<const std::int32_t> truth,
                QuantityMap& made) {
  made.computed = Image<float>(labels.height, labels.width);
  made.computed_valid = Image<std::uint8_t>(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      made.computed_valid.at(y, x) = truth.at(y, x) > 0;
      made.computed.at(y, x) = labels.at(y, x) == truth.at(y, x) ? kGoodPixel : kBadPixel;
    }
  }
  made.inside = made.computed_valid;
}

}  // namespace

std::shared_ptr<QuantityMap> make_segmentation_map(const MapSource& source) {
  auto made = std::make_shared<QuantityMap>();
  made->owner = source.labeling;
  if (source.quantity == Quantity::Edges) {
    made->computed = edges_of(source);
    made->map = made->computed;
    return made;
  }
  const Labeling& labeling = *source.labeling;
  if (source.quantity == Quantity::Segmentation) {
    made->computed_labels = finished_labels(labeling, source.finish, source.view);
    made->labels = made->computed_labels;
    made->label_infos = source.label_infos;
    made->label_style = source.label_style;
    return made;
  }
  if (source.quantity == Quantity::WrongLabels) {
    fill_wrong(finished_labels(labeling, source.finish, source.view),
               source.true_labels->view(source.view), *made);
  } else if (source.quantity == Quantity::Probability) {
    made->computed = probability_of(source.label, labeling.probabilities.view(source.view).view(),
                                    labeling.probabilities.ids);
  } else {
    made->computed = label_uncertainty(labeling.probabilities.view(source.view).view());
  }
  made->map = made->computed;
  return made;
}

}  // namespace episcope
