// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/picture/quantity_map.h"

#include "app/session/picture/result_map.h"
#include "app/session/picture/segmentation_map.h"
#include "engine/evaluation/metrics/error_maps.h"

#include <utility>

namespace episcope {
namespace {

using render::Quantity;
using render::Subject;

using Map = std::shared_ptr<QuantityMap>;

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
      return result_map_of(source.quantity).make(source.estimate, source.view);
    case Subject::Error:
      return error_map(source.evaluation, source);
    case Subject::ResultPair:
      return difference_map(source.estimate->field.view(source.view),
                            source.other->field.view(source.view));
    case Subject::Segmentation:
      return make_segmentation_map(source);
  }
  return nullptr;
}

std::optional<double> QuantityMap::value_at(PixelIndex pixel) const {
  if (pixel.y >= map.height || pixel.x >= map.width) return std::nullopt;
  if (!inside.empty() && inside.at(pixel.y, pixel.x) == 0) return std::nullopt;
  if (!DisparityView{numbers(), valid}.is_valid(pixel.y, pixel.x)) return std::nullopt;
  return numbers().at(pixel.y, pixel.x);
}

}  // namespace episcope
