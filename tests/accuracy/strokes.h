// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/indices.h"

#include <cstdint>
#include <optional>
#include <string>

namespace episcope::accuracy {

/// How a simulated user paints. All know the true labels.
enum class StrokeStyle {
  Cross,   ///< Along a row and a column inside each label (engine/scenes/recipes.h).
  Line,    ///< Along the middle of the largest part of each label.
  Dots,    ///< A few round dots in each label, far from its outline.
  Stored,  ///< What the scene brings along.
};
/// "cross", "line", "dots", "stored". Throws InvalidInput for another name.
[[nodiscard]] StrokeStyle stroke_style(const std::string& name);

/// Labels of fewer pixels than this are not painted, and not to be judged.
inline constexpr int kFewestPixels = 120;

/// Strokes on a view with the given true labels, `[y][x]`, 0 = unpainted: 1 to 4 % of the pixels.
/// No stroke leaves its label.
[[nodiscard]] Image<std::int32_t> simulated_strokes(ImageView<const std::int32_t> labels,
                                                    StrokeStyle style);

/// The pixel farthest from the outline of the largest connected region of wrong pixels that truly
/// have one label; none if every pixel is right.
[[nodiscard]] std::optional<PixelIndex> middle_of_wrong(ImageView<const std::int32_t> labels,
                                                        ImageView<const std::int32_t> truth);

/// Adds the next stroke of a user who corrects `labels`, which were found: on the largest connected
/// region of wrong pixels, from its middle (the pixel farthest from its outline) with a round brush
/// of 8 px along the middle of the region, at most 40 px, with the label that is truly there.
/// Returns false, and paints nothing, if every pixel is right.
bool add_correction(ImageView<const std::int32_t> labels, ImageView<const std::int32_t> truth,
                    ImageView<std::int32_t> strokes);

}  // namespace episcope::accuracy
