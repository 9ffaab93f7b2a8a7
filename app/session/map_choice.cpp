// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/map_choice.h"

#include "app/session/quantity_map.h"

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;

bool is_available_of(const GroundTruth& truth, Quantity quantity) {
  return quantity == Quantity::Truth ? truth.has_disparity() || truth.has_layers()
                                     : truth.has_layers();
}

}  // namespace

bool is_available(const Session& session, Quantity quantity) {
  const auto& scene = session.scene();
  if (!scene) return quantity == Quantity::View;
  switch (render::info_of(quantity).subject) {
    case Subject::LightField:
      return true;
    case Subject::Truth:
      return is_available_of(*scene->truth, quantity);
    case Subject::TrueLabels:
      return session.true_labels() != nullptr;
    case Subject::Result:
      return session.side_a() && has_quantity(*session.side_a()->estimate, quantity);
    case Subject::Error:
      return session.side_a() && is_available_of(*scene->truth, Quantity::Truth);
    case Subject::ResultPair:
      return session.side_b() != nullptr;
    case Subject::Segmentation:
      return false;
  }
  return false;
}

std::optional<MapSource> map_source(Session& session, const MapChoice& choice, ViewIndex view) {
  if (!session.scene() || choice.quantity == Quantity::View) return std::nullopt;
  MapSource source{.quantity = choice.quantity, .view = view, .light_field = session.light_field()};
  const Subject subject = render::info_of(choice.quantity).subject;
  if (subject == Subject::Truth) source.truth = session.scene()->truth;
  if (subject == Subject::TrueLabels) {
    source.true_labels = session.true_labels();
    source.label_infos = session.scene()->scribbles.labels;
    source.label_style = session.label_style();
  }
  if (subject == Subject::Result || subject == Subject::Error || subject == Subject::ResultPair) {
    const EstimateEntry* entry = session.find_estimate(choice.estimate);
    if (!entry) return std::nullopt;
    source.estimate = entry->estimate;
  }
  if (subject == Subject::ResultPair) {
    const EstimateEntry* other = session.find_estimate(choice.other);
    if (!other) return std::nullopt;
    source.other = other->estimate;
  }
  if (!reason_against(source).empty()) return std::nullopt;
  if (subject == Subject::Error) {
    source.evaluation = session.evaluation({choice.estimate, view, Protocol::Vmv2013});
    if (!source.evaluation) return std::nullopt;
    source.bad_threshold_px = session.bad_threshold_px();
  }
  return source;
}

}  // namespace episcope
