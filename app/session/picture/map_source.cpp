// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/map_source.h"

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;

template <class T>
std::string coverage_text(const ViewStack<T>& stack) {
  return std::to_string(stack.grid().v) + "×" + std::to_string(stack.grid().u) +
         " views from view " + view_text(stack.first()) + " on";
}

template <class T>
std::string reason_against_view(const ViewStack<T>& stack, ViewIndex view, const std::string& who,
                                const std::string& what) {
  if (stack.empty()) return who + " has no " + what;
  if (stack.contains(view)) return {};
  return who + " has " + coverage_text(stack) + ", but view " + view_text(view) + " was asked for";
}

std::string reason_against_result(const MapSource& source) {
  const Estimate& estimate = *source.estimate;
  const std::string who = "the result of " + estimate.method;
  switch (source.quantity) {
    case Quantity::Confidence:
      return reason_against_view(estimate.confidence, source.view, who, "confidence");
    case Quantity::Background:
      return reason_against_view(estimate.layered.background.disparity, source.view, who,
                                 "background");
    case Quantity::Layers:
      return reason_against_view(estimate.layered.layers, source.view, who, "number of layers");
    default:
      return reason_against_view(estimate.field.disparity, source.view, who, "disparity");
  }
}

std::string reason_against_segmentation(const MapSource& source) {
  if (source.quantity == Quantity::Edges) return {};
  if (!source.labeling) return "nothing is segmented yet";
  const Labeling& labeling = *source.labeling;
  const std::string who = "the segmentation";
  std::string reason = reason_against_view(labeling.labels, source.view, who, "labels");
  if (!reason.empty() || source.quantity == Quantity::Segmentation) return reason;
  if (source.quantity == Quantity::WrongLabels) {
    return source.true_labels && source.true_labels->contains(source.view)
               ? std::string()
               : source.light_field->info().name + " has no true labels in view " +
                     view_text(source.view);
  }
  const LabelProbabilities& probabilities = labeling.probabilities;
  if (!probabilities.contains(source.view)) return who + " has no probabilities";
  const bool has_label =
      std::ranges::find(probabilities.ids, source.label) != probabilities.ids.end();
  if (has_label || source.quantity != Quantity::Probability) return {};
  std::string known;
  for (const std::int32_t id : probabilities.ids) {
    known += (known.empty() ? "" : ", ") + std::to_string(id);
  }
  return who + " has no label " + std::to_string(source.label) + "; it has " + known;
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

TrueLabelsPtr true_labels_of(const GroundTruthPtr& truth) {
  return truth->labels.empty() ? nullptr : TrueLabelsPtr(truth, &truth->labels);
}

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
    case Subject::ResultPair: {
      std::string reason = reason_against_result(source);
      if (!reason.empty()) return reason;
      return reason_against_view(source.other->field.disparity, source.view,
                                 "the result of " + source.other->method, "disparity");
    }
    case Subject::Segmentation:
      return reason_against_segmentation(source);
  }
  return {};
}

}  // namespace episcope
