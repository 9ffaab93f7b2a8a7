// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/segment_map.h"

#include "engine/labeling/rays/boundary_weights.h"

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;

// As the map of bad pixels: its colours are made for these.
constexpr float kRight = 0.2F;
constexpr float kWrong = 1;

Image<float> probability_of(int label, ViewIndex view, const LabelProbabilities& probabilities) {
  const VolumeView<const std::uint8_t> map = probabilities.view(view).view();
  const auto place = std::ranges::find(probabilities.ids, label) - probabilities.ids.begin();
  Image<float> result(map.height, map.width);
  for (int y = 0; y < map.height; ++y) {
    const std::uint8_t* row = map.row(y, static_cast<int>(place));
    std::transform(row, row + map.width, result.row(y),
                   [](std::uint8_t byte) { return static_cast<float>(byte) / 255; });
  }
  return result;
}

// Those that boundaries between labels go by.
Image<float> edges_of(const OverlaySource& source) {
  const Segmentation* segmentation = source.segmentation.get();
  if (segmentation && segmentation->edges) {
    return larger_edge_probability(segmentation->edges->view(source.view));
  }
  const DisparityField none;
  const bool has_disparity = segmentation && segmentation->disparity;
  return edge_probability(*source.light_field, source.view,
                          has_disparity ? *segmentation->disparity : none, {});
}

void fill_wrong(ImageView<const std::int32_t> labels, ImageView<const std::int32_t> truth,
                OverlayMap& overlay) {
  overlay.computed = Image<float>(labels.height, labels.width);
  overlay.computed_valid = Image<std::uint8_t>(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      overlay.computed_valid.at(y, x) = truth.at(y, x) > 0;
      overlay.computed.at(y, x) = labels.at(y, x) == truth.at(y, x) ? kRight : kWrong;
    }
  }
  overlay.inside = overlay.computed_valid;
}

}  // namespace

std::optional<OverlaySource> segment_source(const Session& session, OverlaySource source) {
  source.light_field = session.light_field();
  source.segmentation = session.segmentation();
  const Quantity quantity = source.choice.quantity;
  if (quantity == Quantity::Edges) return source;
  if (!source.segmentation || !source.segmentation->covers(source.view)) return std::nullopt;
  if (quantity == Quantity::Probability) {
    const auto& ids = source.segmentation->labeling->probabilities.ids;
    if (std::ranges::find(ids, source.segmentation->label) == ids.end()) return std::nullopt;
  }
  if (quantity == Quantity::WrongLabels) {
    source.true_labels = session.true_labels();
    if (!source.true_labels || !source.true_labels->contains(source.view)) return std::nullopt;
  }
  return source;
}

std::shared_ptr<const OverlayMap> make_segment_map(const OverlaySource& source) {
  auto overlay = std::make_shared<OverlayMap>();
  overlay->owners[0] = source.segmentation;
  const ViewIndex view = source.view;
  if (source.choice.quantity == Quantity::Edges) {
    overlay->computed = edges_of(source);
    overlay->map = overlay->computed;
    return overlay;
  }
  const Labeling& labeling = *source.segmentation->labeling;
  if (source.choice.quantity == Quantity::Segmentation) {
    overlay->labels = labeling.labels.view(view);
    overlay->label_infos = source.segmentation->labels;
    return overlay;
  }
  if (source.choice.quantity == Quantity::WrongLabels) {
    fill_wrong(labeling.labels.view(view), source.true_labels->view(view), *overlay);
  } else if (source.choice.quantity == Quantity::Probability) {
    overlay->computed = probability_of(source.segmentation->label, view, labeling.probabilities);
  } else {
    overlay->computed = label_uncertainty(labeling.probabilities.view(view).view());
  }
  overlay->map = overlay->computed;
  return overlay;
}

}  // namespace episcope
