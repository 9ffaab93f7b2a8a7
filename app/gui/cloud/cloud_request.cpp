// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/cloud/cloud_request.h"

#include "app/gui/stage/overlay.h"
#include "app/session/session.h"
#include "widgets/style/quantity_text.h"

#include <QCoreApplication>

namespace episcope {
namespace {

using render::Quantity;

struct Text {
  Q_DECLARE_TR_FUNCTIONS(episcope::CloudRequests)
};

bool is_of_map(CloudColoring coloring) {
  return coloring == CloudColoring::Disparity || coloring == CloudColoring::Error ||
         coloring == CloudColoring::Labels;
}

// What is learnt from strokes, else the true labels.
Quantity labels_of(const Overlay& overlay) {
  return overlay.isAvailable(Quantity::Segmentation) ? Quantity::Segmentation
                                                     : Quantity::TrueLabels;
}

Quantity quantity_of(CloudColoring coloring, const Overlay& overlay) {
  return coloring == CloudColoring::Error    ? Quantity::SignedError
         : coloring == CloudColoring::Labels ? labels_of(overlay)
                                             : Quantity::Disparity;
}

SpaceColoring space_coloring(CloudColoring coloring) {
  if (is_of_map(coloring)) return SpaceColoring::Map;
  return coloring == CloudColoring::Distance ? SpaceColoring::Distance
         : coloring == CloudColoring::Source ? SpaceColoring::Source
                                             : SpaceColoring::View;
}

std::shared_ptr<const DisparityField> field_of(const EstimatePtr& estimate) {
  return {estimate, &estimate->field};
}

}  // namespace

QString CloudRequests::obstacle() const {
  const Session& session = bench_.session;
  if (!session.scene()) return Text::tr("Open a light field first.");
  if (result() || truth()) return {};
  const EstimateEntry* shown = session.shown();
  if (!shown) return Text::tr("Run a method: its disparity appears here in 3D.");
  return Text::tr("%1 has no map of this view. Go to the centre view (Home).")
      .arg(QString::fromStdString(shown->name));
}

const EstimateEntry* CloudRequests::result() const {
  const EstimateEntry* shown = bench_.session.shown();
  return shown && shown->estimate->contains(bench_.session.view()) ? shown : nullptr;
}

std::shared_ptr<const DisparityField> CloudRequests::main() const {
  return result() ? field_of(result()->estimate) : truth();
}

std::shared_ptr<const DisparityField> CloudRequests::truth() const {
  const GroundTruthPtr& truth = bench_.session.scene()->truth;
  if (!truth || !truth->field.contains(bench_.session.view())) return nullptr;
  return {truth, &truth->field};
}

std::shared_ptr<const DisparityField> CloudRequests::other() const {
  const EstimateEntry* entry = bench_.session.compared();
  if (!entry || !entry->estimate || !entry->estimate->contains(bench_.session.view())) {
    return nullptr;
  }
  return field_of(entry->estimate);
}

QString CloudRequests::otherName() const {
  return other() ? QString::fromStdString(bench_.session.compared()->name) : QString();
}

// To what is shown with the result, else to the truth, else to the other result.
std::shared_ptr<const DisparityField> CloudRequests::reference(CloudCompanion companion) const {
  if (companion == CloudCompanion::Other && other()) return other();
  return truth() ? truth() : other();
}

QString CloudRequests::referenceName(const CloudChoice& choice) const {
  return reference(possible(choice).companion) == truth() ? Text::tr("the ground truth")
                                                          : otherName();
}

CloudOffers CloudRequests::offers() const {
  const Session& session = bench_.session;
  CloudOffers offers;
  offers.has_truth = result() && truth();
  offers.has_error = result() && session.has_truth(session.view());
  offers.has_labels = bench_.overlay.isAvailable(Quantity::Segmentation) ||
                      bench_.overlay.isAvailable(Quantity::TrueLabels);
  offers.has_distance =
      result() && session.light_field()->info().camera.is_known() && (truth() || other());
  offers.other = otherName();
  return offers;
}

CloudChoice CloudRequests::possible(CloudChoice choice) const {
  const CloudOffers offered = offers();
  const bool lacks_colors = (choice.coloring == CloudColoring::Error && !offered.has_error) ||
                            (choice.coloring == CloudColoring::Labels && !offered.has_labels) ||
                            (choice.coloring == CloudColoring::Distance && !offered.has_distance);
  if (lacks_colors) choice.coloring = CloudColoring::Image;
  const bool lacks_companion =
      (choice.companion == CloudCompanion::Truth && !offered.has_truth) ||
      (choice.companion == CloudCompanion::Other && offered.other.isEmpty());
  if (lacks_companion) choice.companion = CloudCompanion::None;
  return choice;
}

// The truth has colours of its own.
Quantity CloudRequests::quantity(CloudColoring coloring) const {
  const Quantity quantity = quantity_of(coloring, bench_.overlay);
  return quantity == Quantity::Disparity && !result() ? Quantity::Truth : quantity;
}

std::optional<MapSource> CloudRequests::map(CloudColoring coloring, int estimate) const {
  const Quantity quantity = quantity_of(coloring, bench_.overlay);
  const bool is_of_result = coloring != CloudColoring::Labels;
  return bench_.overlay.sourceOf({quantity, is_of_result ? estimate : 0, 0});
}

std::optional<SpaceRequest> CloudRequests::request(const CloudChoice& wanted) const {
  const CloudChoice choice = possible(wanted);
  Session& session = bench_.session;
  SpaceRequest request;
  request.light_field = session.light_field();
  request.view = session.view();
  request.is_beside = choice.is_beside;
  request.coloring = space_coloring(choice.coloring);
  request.tone = session.place().tone;
  if (choice.is_surface) request.jump_px = choice.jump_px;
  if (choice.coloring == CloudColoring::Distance) request.reference = reference(choice.companion);
  request.sources.push_back({main()});
  if (choice.companion == CloudCompanion::Truth) request.sources.push_back({truth()});
  if (choice.companion == CloudCompanion::Other) request.sources.push_back({other()});
  if (!is_of_map(choice.coloring)) return request;
  request.shading = bench_.overlay.shadingOf(quantity(choice.coloring));
  return addMaps(choice, request) ? std::optional(request) : std::nullopt;
}

bool CloudRequests::addMaps(const CloudChoice& choice, SpaceRequest& request) const {
  const auto truth_map = bench_.overlay.sourceOf({Quantity::Truth, 0, 0});
  const bool is_truth = quantity(choice.coloring) == Quantity::Truth;
  request.sources[0].map = is_truth ? truth_map : map(choice.coloring, result() ? result()->id : 0);
  if (!request.sources[0].map) return false;
  if (request.sources.size() < 2) return true;
  if (choice.companion == CloudCompanion::Other || choice.coloring == CloudColoring::Labels) {
    const EstimateEntry* other = bench_.session.compared();
    request.sources[1].map = map(choice.coloring, other ? other->id : 0);
    return request.sources[1].map.has_value();
  }
  // The truth has no error.
  if (choice.coloring == CloudColoring::Disparity) request.sources[1].map = truth_map;
  return true;
}

QString CloudRequests::title(const CloudChoice& choice) const {
  const QString shown =
      result() ? QString::fromStdString(result()->name) : Text::tr("Ground truth");
  switch (possible(choice).companion) {
    case CloudCompanion::Truth:
      return Text::tr("%1 and the ground truth").arg(shown);
    case CloudCompanion::Other:
      return Text::tr("%1 and %2").arg(shown, otherName());
    case CloudCompanion::None:
      break;
  }
  return shown;
}

QString CloudRequests::legend(const CloudChoice& choice) const {
  switch (possible(choice).coloring) {
    case CloudColoring::Disparity:
    case CloudColoring::Error: {
      const Quantity shown = quantity(choice.coloring);
      return Text::tr("%1 [%2]").arg(quantity_label(shown), quantity_unit(shown));
    }
    case CloudColoring::Distance:
      return Text::tr("distance");
    default:
      return {};
  }
}

}  // namespace episcope
