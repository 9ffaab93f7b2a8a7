// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/map_source.h"

#include "app/session/picture/result_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;

std::string coverage_text(const ViewCoverage& covered) {
  return fmt::format("{}×{} views from view {} on", covered.grid.v, covered.grid.u,
                     view_text(covered.first));
}

bool contains(const ViewCoverage& covered, ViewIndex view) {
  const int v = view.v - covered.first.v;
  const int u = view.u - covered.first.u;
  return v >= 0 && u >= 0 && v < covered.grid.v && u < covered.grid.u;
}

std::string reason_against_view(const ViewCoverage& covered, ViewIndex view, const std::string& who,
                                const std::string& what) {
  if (covered.grid.count() == 0) return who + " has no " + what;
  if (contains(covered, view)) return {};
  return fmt::format("{} has {}, but view {} was asked for", who, coverage_text(covered),
                     view_text(view));
}

std::string reason_against_result(const MapSource& source) {
  const ResultMap& map = result_map_of(source.quantity);
  return reason_against_view(map.coverage(*source.estimate), source.view,
                             "the result of " + source.estimate->method, map.what);
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
      return reason_against_view(coverage_of(source.other->field.disparity), source.view,
                                 "the result of " + source.other->method, "disparity");
    }
    case Subject::Segmentation:
      return reason_against_segmentation(source);
  }
  return {};
}

}  // namespace episcope
