// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/overlay_map.h"

#include "engine/evaluation/error_maps.h"

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
  if (!evaluation) return nullptr;
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
  if (!a->contains(view) || !b->contains(view)) return nullptr;
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

Result estimate_overlay(Session& session, const OverlayChoice& choice, ViewIndex view) {
  const EstimateEntry* entry = session.find_estimate(choice.estimate);
  if (!entry || !entry->estimate->contains(view)) return nullptr;
  const EstimatePtr& estimate = entry->estimate;
  if (const EstimateEntry* other = session.find_estimate(choice.subtracted)) {
    return difference(estimate, other->estimate, view);
  }
  if (choice.quantity == Quantity::Disparity) return borrowed(estimate->field.view(view), estimate);
  if (choice.quantity == Quantity::Confidence) {
    if (!estimate->confidence.contains(view)) return nullptr;
    return borrowed({estimate->confidence.view(view), {}}, estimate);
  }
  return error_overlay(session.evaluation({entry->id, view, Protocol::Vmv2013}), choice.quantity);
}

}  // namespace

std::shared_ptr<const OverlayMap> overlay_map(Session& session, const OverlayChoice& choice,
                                              ViewIndex view) {
  if (!session.scene()) return nullptr;
  switch (choice.quantity) {
    case Quantity::View:
    case Quantity::Labels:
      return nullptr;
    case Quantity::Truth: {
      const GroundTruthPtr truth = session.scene()->truth;
      return truth->field.contains(view) ? borrowed(truth->field.view(view), truth) : nullptr;
    }
    default:
      return estimate_overlay(session, choice, view);
  }
}

Image<std::uint8_t> shade_overlay(const OverlayMap& overlay, const render::Shading& shading) {
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
