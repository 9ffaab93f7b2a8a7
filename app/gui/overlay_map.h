// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/session.h"
#include "engine/render/shade.h"

#include <memory>
#include <optional>
#include <vector>

namespace episcope {

/// What is drawn over a view: a quantity of one estimate, or the difference of two.
struct OverlayChoice {
  render::Quantity quantity = render::Quantity::View;
  int estimate = 0;
  int subtracted = 0;  ///< Another estimate: the map is estimate − subtracted.
  friend bool operator==(const OverlayChoice&, const OverlayChoice&) = default;
};

/// Whether a quantity is of the segmentation, and of no estimate.
[[nodiscard]] bool is_of_segmentation(render::Quantity quantity);

/// Numbers behind an overlay, with all that they are borrowed from.
struct OverlayMap {
  ImageView<const float> map;  ///< Empty: there are labels instead.
  ImageView<const std::int32_t> labels;
  std::vector<LabelInfo> label_infos;    ///< Their colours; of others the default ones.
  ImageView<const std::uint8_t> valid;   ///< 0 = no value; empty = all valid.
  ImageView<const std::uint8_t> inside;  ///< 0 = not judged, not drawn; empty = all drawn.
  Image<float> computed;
  Image<std::uint8_t> computed_valid;
  std::shared_ptr<const void> owners[2];

  /// Nothing outside the map and where there is no value.
  [[nodiscard]] std::optional<double> value_at(PixelIndex pixel) const;
};

/// All that a map is made from, held; makes it on any thread.
struct OverlaySource {
  OverlayChoice choice;
  ViewIndex view;
  EstimatePtr estimate;
  EstimatePtr subtracted;
  GroundTruthPtr truth;
  EvaluationPtr evaluation;
  LightFieldPtr light_field;
  SegmentationPtr segmentation;
  TrueLabelsPtr true_labels;
  friend bool operator==(const OverlaySource&, const OverlaySource&) = default;
};

/// Looks up what a map needs. Nothing if there is no such map for the view, or not yet:
/// Session::evaluation is asked for it.
[[nodiscard]] std::optional<OverlaySource> overlay_source(Session& session,
                                                          const OverlayChoice& choice,
                                                          ViewIndex view);

[[nodiscard]] std::shared_ptr<const OverlayMap> make_overlay_map(const OverlaySource& source);
/// Both at once; null if there is nothing (yet).
[[nodiscard]] std::shared_ptr<const OverlayMap> overlay_map(Session& session,
                                                            const OverlayChoice& choice,
                                                            ViewIndex view);

/// RGBA8 picture, transparent where pixels are not judged.
[[nodiscard]] Image<std::uint8_t> shade_overlay(const OverlayMap& overlay,
                                                const render::Shading& shading);

}  // namespace episcope
