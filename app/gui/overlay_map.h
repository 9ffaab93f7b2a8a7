// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/session.h"
#include "engine/render/shade.h"

#include <memory>
#include <optional>

namespace episcope {

/// What is drawn over a view: a quantity of one estimate, or the difference of two.
struct OverlayChoice {
  render::Quantity quantity = render::Quantity::View;
  int estimate = 0;
  int subtracted = 0;  ///< Another estimate: the map is estimate − subtracted.
  friend bool operator==(const OverlayChoice&, const OverlayChoice&) = default;
};

/// Numbers behind an overlay, with all that they are borrowed from.
struct OverlayMap {
  ImageView<const float> map;
  ImageView<const std::uint8_t> valid;   ///< 0 = no value; empty = all valid.
  ImageView<const std::uint8_t> inside;  ///< 0 = not judged, not drawn; empty = all drawn.
  Image<float> computed;
  Image<std::uint8_t> computed_valid;
  std::shared_ptr<const void> owners[2];
};

/// Null if there is no such map for the view, or not yet: Session::evaluation is asked for it.
[[nodiscard]] std::shared_ptr<const OverlayMap> overlay_map(Session& session,
                                                            const OverlayChoice& choice,
                                                            ViewIndex view);

/// RGBA8 picture, transparent where pixels are not judged.
[[nodiscard]] Image<std::uint8_t> shade_overlay(const OverlayMap& overlay,
                                                const render::Shading& shading);

}  // namespace episcope
