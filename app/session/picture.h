// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/quantity_map.h"
#include "engine/core/point_cloud.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/evaluation/metrics.h"
#include "engine/render/movie.h"
#include "engine/render/shade.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// RGBA8, `[y][x][4]`.
using RgbaImage = Image<std::uint8_t>;

/// A map in its colors; transparent where nothing is judged and where there is no label, so that
/// it can lie over the view.
[[nodiscard]] RgbaImage overlay_picture(const QuantityMap& map, const render::Shading& shading);

/// A map as a picture of its own: what is not judged has the color of invalid pixels; pixels
/// without a label are transparent.
[[nodiscard]] RgbaImage map_picture(const QuantityMap& map, const render::Shading& shading);

/// How a map lies over a view.
struct OverlayLook {
  double opacity = 1;            ///< Of its opaque pixels, in [0, 1].
  bool is_view_colored = false;  ///< Also under a map; under contours of labels it always is.

  bool operator==(const OverlayLook&) const = default;
};

/// A map in its colors over a view of its size, which is grey where the colors stand for numbers,
/// unless `look` keeps it colored. Labels always lie over the colored view.
[[nodiscard]] RgbaImage over_view(RgbaImage view, const QuantityMap& map,
                                  const render::Shading& shading, const OverlayLook& look);

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

enum class PointCloudColoring {
  View,      ///< The view itself.
  Map,       ///< A map of each source.
  Distance,  ///< To the nearest point of the reference.
  Source     ///< One color a source.
};

/// Disparities that become one cloud, with the source of its colors.
struct PointCloudSource {
  std::shared_ptr<const DisparityField> field;
  /// For PointCloudColoring::Map; none: the colors of the view.
  std::optional<MapSource> map{};
};

/// Everything that point clouds are made from, held so that a worker can make them.
struct PointCloudRequest {
  LightFieldPtr light_field;
  ViewIndex view;
  std::vector<PointCloudSource> sources;  ///< Each has a map of `view`.
  bool is_beside = false;                 ///< Sources side by side; else at their places.
  PointCloudColoring coloring = PointCloudColoring::View;
  render::Shading shading{};  ///< Of maps; of distances it is made here.
  render::Tone tone{};        ///< Of the view.
  /// What distances of the first source are measured to; null = none are.
  std::shared_ptr<const DisparityField> reference{};
  /// Neighbors that differ by more are not joined (`join_to_surface`); none = points.
  std::optional<double> jump_px{};
};

struct PointClouds {
  std::vector<CloudPart> parts;  ///< One a source.
  std::optional<CloudDistance> distance;
  /// Of colors that stand for numbers.
  std::optional<render::Shading> shading;
};

/// Colors of the sources for PointCloudColoring::Source, told apart by color-blind people as
/// well.
inline constexpr Rgb kSourceColors[] = {{0xe6, 0x9f, 0x00}, {0x56, 0xb4, 0xe9}};

/// Makes the clouds; pixels that the light field does not show are left out. Throws InvalidInput if
/// distances are asked for and cannot be measured (`cloud_distance`); Cancelled.
[[nodiscard]] PointClouds make_point_clouds(const PointCloudRequest& request,
                                            const Progress& progress);

/// Writes all points of a scene, with surfaces, as one PLY file. Atomic. Throws IoError,
/// InvalidInput if there is no point.
void save_point_clouds(const std::filesystem::path& path, const std::vector<CloudPart>& parts);

}  // namespace episcope
