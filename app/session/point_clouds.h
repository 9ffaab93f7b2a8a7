// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/quantity_map.h"
#include "engine/core/point_cloud.h"
#include "engine/evaluation/metrics.h"
#include "engine/render/shade.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace episcope {

/// What colors the points.
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
