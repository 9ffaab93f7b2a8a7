// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/judge.h"
#include "app/session/segmentation.h"
#include "app/session/session.h"
#include "engine/core/estimate.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/scene.h"
#include "engine/evaluation/metrics.h"
#include "engine/render/quantity.h"
#include "engine/render/shade.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// Everything that a map of one view is made from, held so that a worker can make the map while the
/// owners change. What the quantity does not need may be null.
struct MapSource {
  render::Quantity quantity = render::Quantity::View;
  ViewIndex view{};
  LightFieldPtr light_field{};
  GroundTruthPtr truth{};
  EstimatePtr estimate{};
  EstimatePtr other{};                              ///< For a difference: estimate − other.
  EvaluationPtr evaluation{};                       ///< Of `estimate` in `view`.
  double bad_threshold_px = kBadPixelThreshold_px;  ///< For BadPixels.
  LabelingPtr labeling{};                ///< For what is of a segmentation, but for Edges.
  LabelFinish finish{};                  ///< Of its labels.
  std::vector<LabelInfo> label_infos{};  ///< Colors of its labels; others have the default ones.
  render::LabelStyle label_style{};      ///< How they are drawn.
  int label = 0;                         ///< Whose probability.
  /// For Edges: EDGE_WEIGHTS of a file, else computed from the image and, if it is known,
  /// disparity.
  std::shared_ptr<const ViewStack<float>> edges{};
  std::shared_ptr<const DisparityField> edge_disparity{};
  TrueLabelsPtr true_labels{};
  /// Names of true labels, for WrongLabels: numbers may differ (match_labels). None = they agree.
  std::optional<std::vector<LabelInfo>> true_label_infos{};
  friend bool operator==(const MapSource&, const MapSource&) = default;
};

/// Why there is no such map of this view, as a sentence without its full stop; empty if there is
/// one. Preconditions: there is a light field; estimates are there where the quantity is of one.
/// Whether there is an evaluation is not looked at: see `can_judge`.
[[nodiscard]] std::string reason_against(const MapSource& source);

/// The numbers, or labels, of a quantity in one view, with everything that they are borrowed from.
struct QuantityMap {
  ImageView<const float> map;  ///< `[y][x]`; empty: there are labels instead.
  ImageView<const std::int32_t> labels;
  /// Numbers of the pixels if `map` only chooses colors; empty: `map` holds the numbers.
  ImageView<const float> measured;
  std::vector<LabelInfo> label_infos;    ///< Their colors; others have the default ones.
  render::LabelStyle label_style{};      ///< How they are drawn.
  ImageView<const std::uint8_t> valid;   ///< 0 = no value; empty = all valid.
  ImageView<const std::uint8_t> inside;  ///< 0 = not judged; empty = all are.
  bool has_bad_alone = false;            ///< Over a view, only pixels of kBadPixel are drawn.
  Image<float> computed;
  Image<float> computed_measured;
  Image<std::uint8_t> computed_valid;
  Image<std::int32_t> computed_labels;
  std::shared_ptr<const void> owner;

  /// The numbers of the map: `measured` where there are such.
  [[nodiscard]] const ImageView<const float>& numbers() const {
    return measured.empty() ? map : measured;
  }
  /// One of them. Nothing outside the map, where nothing is judged, and where there is no value.
  [[nodiscard]] std::optional<double> value_at(PixelIndex pixel) const;
};

using QuantityMapPtr = std::shared_ptr<const QuantityMap>;

/// Makes the map; for any thread. Null for Quantity::View, whose samples are in the light field.
/// Preconditions: `reason_against(source)` is empty; there is an evaluation if the quantity is an
/// error.
[[nodiscard]] QuantityMapPtr make_map(const MapSource& source);

/// Which map of the session: a quantity, of which estimates.
struct MapChoice {
  render::Quantity quantity = render::Quantity::View;
  int estimate = 0;
  int other = 0;  ///< For a difference: estimate − other.
  friend bool operator==(const MapChoice&, const MapChoice&) = default;
};

/// Whether a quantity can be shown now, in some view. Quantities of a segmentation cannot, since
/// the session does not hold it.
[[nodiscard]] bool is_available(const Session& session, render::Quantity quantity);

/// Looks up what a map of a view is made from. None for the view itself and for maps that do not
/// exist, or not yet: then asks Session::evaluation for what is missing.
[[nodiscard]] std::optional<MapSource> map_source(Session& session, const MapChoice& choice,
                                                  ViewIndex view);

}  // namespace episcope
