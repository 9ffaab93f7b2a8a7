// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/overlay_map.h"

#include "app/gui/segment_map.h"
#include "engine/evaluation/metrics/error_maps.h"

#include <algorithm>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;

// Threshold of the map of bad pixels; strictly above is bad [HJKG16].
constexpr double kBadPixelThreshold = 0.07;

using Result = std::shared_ptr<const OverlayMap>;

Result borrowed(const DisparityView& view, std::shared_ptr<const void> owner) {
  auto overlay = std::make_shared<OverlayMap>();
  overlay->map = view.disparity;
  overlay->valid = view.valid;
  overlay->owners[0] = std::move(owner);
  return overlay;
}

Result error_overlay(const EvaluationPtr& evaluation, Quantity quantity) {
  auto overlay = std::make_shared<OverlayMap>();
  if (quantity == Quantity::SignedError) {
    overlay->map = evaluation->signed_error;
  } else {
    overlay->computed = quantity == Quantity::AbsoluteError
                            ? absolute_error_map(*evaluation)
                            : bad_pixel_map(*evaluation, kBadPixelThreshold);
    overlay->map = overlay->computed;
  }
  // A missing estimate has no error to draw, but it is a bad pixel.
  overlay->computed_valid = Image<std::uint8_t>(overlay->map.height, overlay->map.width, 1, 1);
  if (quantity != Quantity::BadPixels && !evaluation->missing.empty()) {
    for (std::size_t i = 0; i < overlay->computed_valid.size(); ++i) {
      overlay->computed_valid.data()[i] = evaluation->missing.data()[i] == 0;
    }
  }
  overlay->valid = overlay->computed_valid;
  overlay->inside = evaluation->judged;
  overlay->owners[0] = evaluation;
  return overlay;
}

Result difference(const EstimatePtr& a, const EstimatePtr& b, ViewIndex view) {
  const DisparityView left = a->field.view(view);
  const DisparityView right = b->field.view(view);
  auto overlay = std::make_shared<OverlayMap>();
  overlay->computed = Image<float>(left.disparity.height, left.disparity.width);
  overlay->computed_valid = Image<std::uint8_t>(left.disparity.height, left.disparity.width);
  for (int y = 0; y < left.disparity.height; ++y) {
    for (int x = 0; x < left.disparity.width; ++x) {
      if (!left.is_valid(y, x) || !right.is_valid(y, x)) continue;
      overlay->computed_valid.at(y, x) = 1;
      overlay->computed.at(y, x) = left.disparity.at(y, x) - right.disparity.at(y, x);
    }
  }
  overlay->map = overlay->computed;
  overlay->valid = overlay->computed_valid;
  return overlay;
}

Result layer_count(const EstimatePtr& estimate, ViewIndex view) {
  const ImageView<const std::uint8_t> layers = estimate->layered.layers.view(view);
  auto overlay = std::make_shared<OverlayMap>();
  overlay->computed = Image<float>(layers.height, layers.width);
  std::copy_n(layers.data, layers.size(), overlay->computed.data());
  overlay->map = overlay->computed;
  return overlay;
}

Result labels_overlay(const OverlaySource& source) {
  auto overlay = std::make_shared<OverlayMap>();
  overlay->labels = source.true_labels->view(source.view);
  overlay->owners[0] = source.true_labels;
  return overlay;
}

bool needs_evaluation(Quantity quantity) {
  return quantity == Quantity::SignedError || quantity == Quantity::AbsoluteError ||
         quantity == Quantity::BadPixels;
}

std::optional<OverlaySource> estimate_source(Session& session, OverlaySource source) {
  const EstimateEntry* entry = session.find_estimate(source.choice.estimate);
  if (!entry || !entry->estimate->contains(source.view)) return std::nullopt;
  source.estimate = entry->estimate;
  if (const EstimateEntry* other = session.find_estimate(source.choice.subtracted)) {
    source.subtracted = other->estimate;
    if (!other->estimate->contains(source.view)) return std::nullopt;
  } else if (source.choice.quantity == Quantity::Confidence) {
    if (!entry->estimate->confidence.contains(source.view)) return std::nullopt;
  } else if (source.choice.quantity == Quantity::Background) {
    if (!entry->estimate->layered.background.contains(source.view)) return std::nullopt;
  } else if (source.choice.quantity == Quantity::Layers) {
    const auto& layers = entry->estimate->layered.layers;
    if (layers.empty() || !layers.contains(source.view)) return std::nullopt;
  } else if (needs_evaluation(source.choice.quantity)) {
    source.evaluation = session.evaluation({entry->id, source.view, Protocol::Vmv2013});
    if (!source.evaluation) return std::nullopt;
  }
  return source;
}

}  // namespace

bool is_of_segmentation(Quantity quantity) {
  return quantity == Quantity::Segmentation || quantity == Quantity::Probability ||
         quantity == Quantity::Uncertainty || quantity == Quantity::Edges ||
         quantity == Quantity::WrongLabels;
}

std::optional<OverlaySource> overlay_source(Session& session, const OverlayChoice& choice,
                                            ViewIndex view) {
  if (!session.scene()) return std::nullopt;
  OverlaySource source{choice, view, {}, {}, {}, {}, {}, {}, {}};
  if (is_of_segmentation(choice.quantity)) return segment_source(session, std::move(source));
  switch (choice.quantity) {
    case Quantity::View:
      return std::nullopt;
    case Quantity::Labels:
      source.true_labels = session.true_labels();
      if (!source.true_labels || !source.true_labels->contains(view)) return std::nullopt;
      return source;
    case Quantity::Truth:
      source.truth = session.scene()->truth;
      if (!source.truth->field.contains(view)) return std::nullopt;
      return source;
    default:
      return estimate_source(session, std::move(source));
  }
}

std::shared_ptr<const OverlayMap> make_overlay_map(const OverlaySource& source) {
  if (is_of_segmentation(source.choice.quantity)) return make_segment_map(source);
  if (source.choice.quantity == Quantity::Labels) return labels_overlay(source);
  if (source.truth) return borrowed(source.truth->field.view(source.view), source.truth);
  if (source.subtracted) return difference(source.estimate, source.subtracted, source.view);
  if (source.evaluation) return error_overlay(source.evaluation, source.choice.quantity);
  if (source.choice.quantity == Quantity::Confidence) {
    return borrowed({source.estimate->confidence.view(source.view), {}}, source.estimate);
  }
  if (source.choice.quantity == Quantity::Background) {
    return borrowed(source.estimate->layered.background.view(source.view), source.estimate);
  }
  if (source.choice.quantity == Quantity::Layers) return layer_count(source.estimate, source.view);
  return borrowed(source.estimate->field.view(source.view), source.estimate);
}

std::shared_ptr<const OverlayMap> overlay_map(Session& session, const OverlayChoice& choice,
                                              ViewIndex view) {
  const auto source = overlay_source(session, choice, view);
  return source ? make_overlay_map(*source) : nullptr;
}

std::optional<double> OverlayMap::value_at(PixelIndex pixel) const {
  if (pixel.y >= map.height || pixel.x >= map.width) return std::nullopt;
  if (!inside.empty() && inside.at(pixel.y, pixel.x) == 0) return std::nullopt;
  if (!DisparityView{map, valid}.is_valid(pixel.y, pixel.x)) return std::nullopt;
  return map.at(pixel.y, pixel.x);
}

Image<std::uint8_t> shade_overlay(const OverlayMap& overlay, const render::Shading& shading) {
  if (!overlay.labels.empty()) return render::shade_labels(overlay.labels, overlay.label_infos);
  Image<std::uint8_t> picture = render::shade(overlay.map, overlay.valid, shading);
  if (overlay.inside.empty()) return picture;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      if (overlay.inside.at(y, x) == 0) picture.at(y, x, 3) = 0;
    }
  }
  return picture;
}

}  // namespace episcope
