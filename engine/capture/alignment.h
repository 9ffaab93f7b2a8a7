// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/core/image.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <array>
#include <optional>
#include <vector>

namespace episcope::capture {

/// A match of a patch in another picture.
struct PatchMatch {
  PlanePoint place;  ///< In px.
  double gain = 1;   ///< Brightness of the match relative to the patch.
};

/// Finds a square of one picture in others, to sub-pixel precision and for any gain and offset, by
/// Gauss-Newton on shift, gain and offset (Baker, Matthews: Lucas-Kanade 20 years on, IJCV 2004,
/// with the constant Jacobian of the template).
class Patch {
 public:
  static constexpr int kReach = 8;
  static constexpr int kSide = 2 * kReach + 1;

  /// Around a whole pixel. Precondition: at least kReach + 1 px from the border.
  Patch(ImageView<const float> picture, int y, int x);

  /// Nothing if it is not found within 2 px of `guess`, does not look alike, or has no texture.
  [[nodiscard]] std::optional<PatchMatch> find(ImageView<const float> picture,
                                               const PlanePoint& guess) const;

 private:
  static constexpr int kCount = kSide * kSide;
  std::array<float, kCount> template_{};
  std::array<std::array<float, kCount>, 4> update_{};  ///< (JᵀJ)⁻¹Jᵀ by x, y, gain, offset.
  double contrast_ = 0;                                ///< Standard deviation.
};

/// Points of the center view, followed through all views.
struct ViewMatches {
  GridShape grid;
  std::vector<PlanePoint> points;  ///< In the center view, px.
  /// By view (row by row) and point; nothing where a point was not found.
  std::vector<std::vector<std::optional<PatchMatch>>> found;

  [[nodiscard]] const std::vector<std::optional<PatchMatch>>& of(ViewIndex view) const {
    return found[static_cast<std::size_t>(view.v) * grid.u + view.u];
  }
};

/// Finds corners of the center view in all others; the parallax of neighbors may be up to an
/// eighth of the width. Throws InvalidInput if fewer than 30 points can be followed; Cancelled.
[[nodiscard]] ViewMatches match_views(const LightField& field, const Progress& progress);

/// Differences in y of the same point in horizontal neighbors, absolute, in px, ascending.
[[nodiscard]] std::vector<double> vertical_disparities(const ViewMatches& matches);

/// The median gain of each view against the center view, row by row.
[[nodiscard]] std::vector<double> view_gains(const ViewMatches& matches);

/// Correction of one view beside the common rotation: offset of a point from its place on the grid
/// in px, a homography to first order, in x and y of the ray (x, y, 1).
struct ViewCorrection {
  std::array<double, 8> parameters{};
  [[nodiscard]] PlanePoint at(double x, double y) const {
    const auto& h = parameters;
    const double bend = h[6] * x + h[7] * y;
    return {h[0] + h[1] * x + h[2] * y + bend * x, h[3] + h[4] * x + h[5] * y + bend * y};
  }
};

/// Transformation from photographs to a rectified light field.
struct Alignment {
  /// Rotation from the camera to the axes of the gantry, row by row.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  double focal_px = 0;  ///< Of the rotated camera, which keeps the principal point of the lens.
  std::vector<ViewCorrection> corrections;  ///< Row by row.
  std::vector<double> parallax;             ///< Of each point, px per view step, before any shift.
  double residual_px = 0;                   ///< Median distance of matches from the model.

  /// Angle of the rotation in degrees about the optical axis.
  [[nodiscard]] double roll_degrees() const;
};

/// Finds the rotation between camera and gantry for which all points have equal parallax along rows
/// and columns, and the correction of each view, robustly (Huber, 0.3 px). Corrections have no
/// trend along rows or columns, which would be parallax. Throws InvalidInput if the matches do not
/// fit a grid.
[[nodiscard]] Alignment align(const ViewMatches& matches, const LensCamera& camera);

/// A view for matching: gray, in units of 1/255, smoothed by a Gaussian of 0.8 px, so that noise
/// and interpolation do not draw matches to whole pixels.
[[nodiscard]] Image<float> gray_view(const LightField& field, ViewIndex view);

}  // namespace episcope::capture
