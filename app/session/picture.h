// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/quantity_map.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/render/movie.h"
#include "engine/render/shade.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace episcope {

/// RGBA8, `[y][x][4]`.
using RgbaImage = Image<std::uint8_t>;

/// A map in its colors; transparent where nothing is judged and where there is no label, so that
/// it can lie over the view.
[[nodiscard]] RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading);

/// A map as a picture of its own: what is not judged has the color of invalid pixels; pixels
/// without a label are transparent.
[[nodiscard]] RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading);

/// `over` on `under`, both of one size; its opaque pixels count `opacity`, in [0, 1], others less.
[[nodiscard]] RgbaImage blended(const RgbaImage& under, const RgbaImage& over, double opacity);

/// An EPI through a pixel of a view, every row of it `kEpiRowHeight` pixels high. A horizontal one
/// has x to the right and u downwards; a vertical one stands upright, y downwards and v to the
/// right. Throws InvalidInput if the line lies outside the image.
inline constexpr int kEpiRowHeight = 8;
[[nodiscard]] RgbaImage horizontal_epi_picture(const LightField& light_field, ViewIndex view,
                                               int y);
[[nodiscard]] RgbaImage vertical_epi_picture(const LightField& light_field, ViewIndex view, int x);

/// What a user may override in the colors of a quantity.
struct ShadingChoice {
  std::optional<Interval> range;
  std::string color_map{};  ///< Empty = the quantity's own.
};

/// Colors of a quantity; disparities span `disparity_range`. Throws InvalidInput for an unknown
/// color map.
[[nodiscard]] render::Shading shading_of(render::Quantity quantity, Interval disparity_range,
                                         const ShadingChoice& choice = {});

/// What a movie is made from.
struct MovieSubject {
  MapSource source;                  ///< The map, as it stands in the view that is shown.
  std::optional<MapSource> other{};  ///< Of a flip.
  const Scene* scene = nullptr;      ///< Judges errors in other views; outlives the movie.
  /// Draws a map, or the view of the light field; for any thread.
  std::function<RgbaImage(const MapSource&)> draw;
  const render::ToneTable* tone = nullptr;  ///< Of refocused views; outlives the movie.
};

/// Pictures of one size, made when they are asked for.
struct Movie {
  int count = 0;
  double rate = 10;  ///< Pictures per second.
  std::function<RgbaImage(int)> picture;
};

/// A parallax skips views without the map. Throws InvalidInput if all along the path do, if no view
/// is refocused or if `other` is missing.
[[nodiscard]] Movie make_movie(const render::MovieChoice& choice, const MovieSubject& subject);

/// Makes the pictures and writes them. Throws what io::MovieFile does, Cancelled.
void write_movie(const std::filesystem::path& path, const Movie& movie, int width_px,
                 const Progress& progress);

}  // namespace episcope
