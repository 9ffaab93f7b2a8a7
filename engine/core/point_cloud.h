// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/disparity_field.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace episcope {

/// Maps pixels with a disparity to points: x to the right, y up, z towards the viewer (image axes
/// with y and z turned).
///
/// With a known camera, points are in units of the scene: Z by eq. (1) [WMG13], X and Y by the
/// pinhole model. It uses CameraGrid::pinhole, or else the image center with a focal length of
/// f·xRes px (a small f is relative to the image width). Without a camera, x and y are pixels and z
/// is a multiple of the disparity.
class BackProjection {
 public:
  /// `z_per_px`: z of one px of disparity where the camera is not known.
  BackProjection(const CameraGrid& camera, int height, int width, double z_per_px);

  /// Not finite where no point in front of the camera has that disparity.
  [[nodiscard]] std::array<double, 3> operator()(int y, int x, double disparity_px) const {
    const double right = x - center_x_;
    const double up = center_y_ - y;
    if (!is_metric_) return {right, up, disparity_px * z_per_px_};
    const double depth = camera_.depth_from_disparity(disparity_px);
    return {right * depth / focal_px_, up * depth / focal_px_, -depth};
  }

  /// Whether places are in units of the scene.
  [[nodiscard]] bool is_metric() const { return is_metric_; }

 private:
  CameraGrid camera_;
  bool is_metric_;
  double center_x_;
  double center_y_;
  double focal_px_;
  double z_per_px_;
};

/// Colored points: x to the right, y up, z towards the viewer (image axes with y and z turned).
struct PointCloud {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint8_t, 3>> colors;  ///< One a position.
  std::vector<PixelIndex> pixels{};  ///< Where each is from, one a position; may be empty.
  /// Of positions; empty: the points alone are drawn.
  std::vector<std::array<std::uint32_t, 3>> triangles{};
  bool is_metric = false;  ///< Positions are in scene units, not in stretched disparity.
};

/// A cloud and a subset of its points, which is drawn while it moves.
struct CloudPart {
  PointCloud all;
  PointCloud few;  ///< Without positions: `all` is drawn then as well.
};

/// A box {x0, x1, y0, y1, z0, z1} around the bulk of a cloud, all 0 for an empty one. Half a
/// percent of the points may lie beyond each side, so that a few wild depths do not shrink the rest
/// to a dot. Linear.
[[nodiscard]] std::array<double, 6> robust_bounds(const PointCloud& cloud);

/// Density of the points of a cloud, and their depth where the camera is not known.
struct CloudSampling {
  int step = 1;  ///< Every `step`-th pixel of both directions is taken.
  /// z of one px of disparity where the camera is not known; none = a 20th of the larger image
  /// side.
  std::optional<double> z_per_px{};
};

/// The valid pixels of one view, placed by `BackProjection`, in the order of rows. `rgba` is
/// `[y][x][4]` and has the size of the map. Throws InvalidInput if not, or if the step is < 1.
[[nodiscard]] PointCloud make_point_cloud(const DisparityView& view, const CameraGrid& camera,
                                          ImageView<const std::uint8_t> rgba,
                                          const CloudSampling& sampling = {});

/// Joins the points of a cloud to a surface of triangles, cut at jumps. `cloud` holds every
/// `step`-th pixel of `view`.
///
/// Four neighboring points (`step` pixels apart along x and y) make two triangles, divided along
/// the diagonal whose ends differ less in disparity. Three points make one triangle if the fourth
/// is missing. A triangle is left out if two of its corners differ in disparity by more than
/// `jump_px` · `step`: there one surface ends in front of another. `jump_px` is in px of disparity
/// per pixel of the image. Linear. Throws InvalidInput unless jump_px > 0.
void join_to_surface(PointCloud& cloud, const DisparityView& view, int step, double jump_px);

}  // namespace episcope
