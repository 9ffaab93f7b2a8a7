// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/quantity_map.h"

#include "app/session/result_fit.h"
#include "engine/core/text.h"
#include "engine/evaluation/label_quality.h"
#include "engine/labeling/pixel_features.h"
#include "engine/labeling/ray_labeling.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;
using Map = std::shared_ptr<QuantityMap>;

/// A map that `owner` keeps alive.
Map borrowed_map(const DisparityView& view, std::shared_ptr<const void> owner) {
  auto made = std::make_shared<QuantityMap>();
  made->map = view.disparity;
  made->valid = view.valid;
  made->owner = std::move(owner);
  return made;
}

Map made_map(const DisparityField& field, ViewIndex view, const EstimatePtr& owner) {
  return borrowed_map(field.view(view), owner);
}
Map made_map(const ViewStack<float>& values, ViewIndex view, const EstimatePtr& owner) {
  return borrowed_map({values.view(view), {}}, owner);
}
Map made_map(const ViewStack<std::uint8_t>& counts, ViewIndex view, const EstimatePtr&) {
  auto made = std::make_shared<QuantityMap>();
  made->computed = Image<float>(counts.height(), counts.width());
  std::copy_n(counts.view(view).data, counts.view_size(), made->computed.data());
  made->map = made->computed;
  return made;
}

ViewRectangle coverage_of(const DisparityField& field) {
  return coverage_of(field.disparity);
}

/// Calls `use` with the maps of a result that a quantity is found in, and their name in a sentence;
/// quantities of other subjects (render::Subject) are computed from the disparity.
template <class Use>
auto with_maps_of(const Estimate& estimate, Quantity quantity, const Use& use) {
  switch (quantity) {
    case Quantity::Confidence:
      return use(estimate.confidence, "confidence");
    case Quantity::Second:
      return use(estimate.second, "second disparity");
    case Quantity::Background:
      return use(estimate.layered.background, "background");
    case Quantity::Layers:
      return use(estimate.layered.layers, "number of layers");
    default:
      return use(estimate.field, "disparity");
  }
}

std::string who_of(const Estimate& estimate) {
  return "the result of " + estimate.method;
}

std::string reason_against_result(const MapSource& source) {
  const std::string who = who_of(*source.estimate);
  std::string reason =
      with_maps_of(*source.estimate, source.quantity, [&](const auto& maps, const char* what) {
        return reason_against_view(coverage_of(maps), source.view, who, what);
      });
  if (!reason.empty() || !source.light_field) return reason;
  return reason_against_fit(who, geometry_of(source.estimate->field.disparity),
                            source.light_field->info().name, geometry_of(*source.light_field));
}

std::string reason_against_pair(const MapSource& source) {
  std::string reason = reason_against_result(source);
  if (!reason.empty()) return reason;
  const ViewStack<float>& other = source.other->field.disparity;
  const std::string who = who_of(*source.other);
  reason = reason_against_view(coverage_of(other), source.view, who, "disparity");
  if (!reason.empty()) return reason;
  return reason_against_fit(who, geometry_of(other), "that of " + source.estimate->method,
                            geometry_of(source.estimate->field.disparity));
}

std::string reason_against_segmentation(const MapSource& source) {
  if (source.quantity == Quantity::Edges) return {};
  if (!source.labeling) return "nothing is segmented yet";
  const Labeling& labeling = *source.labeling;
  const std::string who = "the segmentation";
  std::string reason =
      reason_against_view(coverage_of(labeling.labels), source.view, who, "labels");
  if (!reason.empty() || source.quantity == Quantity::Segmentation) return reason;
  if (source.quantity == Quantity::WrongLabels) {
    if (!source.true_labels || !source.true_labels->contains(source.view)) {
      return source.light_field->info().name + " has no true labels in view " +
             view_text(source.view);
    }
    return reason_against_fit(who, geometry_of(labeling.labels), source.light_field->info().name,
                              geometry_of(*source.light_field));
  }
  const LabelProbabilities& probabilities = labeling.probabilities;
  if (!probabilities.contains(source.view)) return who + " has no probabilities";
  const bool has_label =
      std::ranges::find(probabilities.ids, source.label) != probabilities.ids.end();
  if (has_label || source.quantity != Quantity::Probability) return {};
  return who + " has no label " + std::to_string(source.label) + "; it has " +
         joined(probabilities.ids, ", ", [](std::int32_t id) { return std::to_string(id); });
}

std::string reason_against_truth(const MapSource& source) {
  const bool is_behind = source.quantity == Quantity::TruthBackground;
  const DisparityField& single =
      source.truth->has_disparity() ? source.truth->field : source.truth->foreground;
  const DisparityField& field = is_behind ? source.truth->background : single;
  if (field.contains(source.view)) return {};
  return source.light_field->info().name + " has no true " +
         (is_behind ? "background" : "disparity") + " in view " + view_text(source.view);
}

}  // namespace

std::string reason_against(const MapSource& source) {
  switch (render::info_of(source.quantity).subject) {
    case Subject::LightField:
      return {};
    case Subject::Truth:
      return reason_against_truth(source);
    case Subject::TrueLabels:
      if (source.true_labels && source.true_labels->contains(source.view)) return {};
      return source.light_field->info().name + " has no labels in view " + view_text(source.view);
    case Subject::Result:
    case Subject::Error:
      return reason_against_result(source);
    case Subject::ResultPair:
      return reason_against_pair(source);
    case Subject::Segmentation:
      return reason_against_segmentation(source);
  }
  return {};
}

namespace {

// A missing estimate has no error to draw, but it is a bad pixel.
void fill_bad_pixels(const Evaluation& evaluation, double threshold_px, QuantityMap& made) {
  made.computed = bad_pixel_map(evaluation, threshold_px);
  made.computed_measured = absolute_error_map(evaluation);
  made.map = made.computed;
  made.measured = made.computed_measured;
}

Map error_map(const EvaluationPtr& evaluation, const MapSource& source) {
  auto made = std::make_shared<QuantityMap>();
  if (source.quantity == Quantity::BadPixels) {
    fill_bad_pixels(*evaluation, source.bad_threshold_px, *made);
  } else {
    made->computed_valid = present_mask(*evaluation);
    made->valid = made->computed_valid;
    if (source.quantity == Quantity::AbsoluteError)
      made->computed = absolute_error_map(*evaluation);
    made->map = source.quantity == Quantity::AbsoluteError
                    ? ImageView<const float>(made->computed)
                    : ImageView<const float>(evaluation->signed_error);
  }
  made->inside = evaluation->judged;
  made->owner = evaluation;
  return made;
}

Map difference_map(const DisparityView& left, const DisparityView& right) {
  auto made = std::make_shared<QuantityMap>();
  made->computed = Image<float>(left.disparity.height, left.disparity.width);
  made->computed_valid = Image<std::uint8_t>(left.disparity.height, left.disparity.width);
  for (int y = 0; y < left.disparity.height; ++y) {
    for (int x = 0; x < left.disparity.width; ++x) {
      if (!left.is_valid(y, x) || !right.is_valid(y, x)) continue;
      made->computed_valid.at(y, x) = 1;
      made->computed.at(y, x) = left.disparity.at(y, x) - right.disparity.at(y, x);
    }
  }
  made->map = made->computed;
  made->valid = made->computed_valid;
  return made;
}

Map truth_map(const MapSource& source) {
  const GroundTruth& truth = *source.truth;
  const DisparityField& single = truth.has_disparity() ? truth.field : truth.foreground;
  const bool is_behind = source.quantity == Quantity::TruthBackground;
  return borrowed_map((is_behind ? truth.background : single).view(source.view), source.truth);
}

Map labels_map(const MapSource& source) {
  auto made = std::make_shared<QuantityMap>();
  made->labels = source.true_labels->view(source.view);
  made->label_infos = source.label_infos;
  made->label_style = source.label_style;
  made->owner = source.true_labels;
  return made;
}

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

void fill_wrong(ImageView<const std::int32_t> labels, const MapSource& source, QuantityMap& made) {
  const ImageView<const std::int32_t> truth = source.true_labels->view(source.view);
  LabelMatch match;
  if (source.true_label_infos) {
    match = match_labels(judge_labels(labels, truth), source.label_infos, *source.true_label_infos);
  }
  const auto is_right = [&](std::int32_t given, std::int32_t right) {
    if (!source.true_label_infos) return given == right;
    const auto found = match.true_of.find(given);
    return found != match.true_of.end() && found->second == right;
  };
  made.computed = Image<float>(labels.height, labels.width);
  made.computed_valid = Image<std::uint8_t>(labels.height, labels.width);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      made.computed_valid.at(y, x) = truth.at(y, x) > 0;
      made.computed.at(y, x) = is_right(labels.at(y, x), truth.at(y, x)) ? kGoodPixel : kBadPixel;
    }
  }
  made.inside = made.computed_valid;
  made.has_bad_alone = true;
}

Map segmentation_map(const MapSource& source) {
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
    fill_wrong(finished_labels(labeling, source.finish, source.view), source, *made);
  } else if (source.quantity == Quantity::Probability) {
    made->computed = probability_of(source.label, labeling.probabilities.view(source.view).view(),
                                    labeling.probabilities.ids);
  } else {
    made->computed = label_uncertainty(labeling.probabilities.view(source.view).view());
  }
  made->map = made->computed;
  return made;
}

}  // namespace

QuantityMapPtr make_map(const MapSource& source) {
  switch (render::info_of(source.quantity).subject) {
    case Subject::LightField:
      break;
    case Subject::Truth:
      return truth_map(source);
    case Subject::TrueLabels:
      return labels_map(source);
    case Subject::Result:
      return with_maps_of(*source.estimate, source.quantity, [&](const auto& maps, const char*) {
        return made_map(maps, source.view, source.estimate);
      });
    case Subject::Error:
      return error_map(source.evaluation, source);
    case Subject::ResultPair:
      return difference_map(source.estimate->field.view(source.view),
                            source.other->field.view(source.view));
    case Subject::Segmentation:
      return segmentation_map(source);
  }
  return nullptr;
}

std::optional<double> QuantityMap::value_at(PixelIndex pixel) const {
  if (pixel.y >= map.height || pixel.x >= map.width) return std::nullopt;
  if (!inside.empty() && inside.at(pixel.y, pixel.x) == 0) return std::nullopt;
  if (!DisparityView{numbers(), valid}.is_valid(pixel.y, pixel.x)) return std::nullopt;
  return numbers().at(pixel.y, pixel.x);
}

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
      return session.side_a() &&
             with_maps_of(*session.side_a()->estimate, quantity, [](const auto& maps, const char*) {
               return coverage_of(maps).grid.count() > 0;
             });
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
