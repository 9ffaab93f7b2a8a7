// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/alignment.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/schema.h"

#include <cstddef>
#include <vector>

namespace episcope::capture {

struct RectifyOptions {
  double step = 1;        ///< Between neighboring positions of the gantry, in the mesh's unit.
  bool equalize = false;  ///< Divide each view by its gain.
  friend bool operator==(const RectifyOptions&, const RectifyOptions&) = default;
};

[[nodiscard]] Schema<RectifyOptions> rectify_schema();

/// Vertical disparity of horizontal neighbors, absolute, in px.
struct RowErrors {
  double median = 0;
  double percentile_95 = 0;
  friend bool operator==(const RowErrors&, const RowErrors&) = default;
};

struct Rectified {
  LightFieldPtr light_field;
  Alignment alignment;
  std::vector<double> gains;  ///< Of the photographs against the center, row by row.
  RowErrors before;           ///< Of the photographs,
  RowErrors after;            ///< measured again in the rectified views.
  std::size_t points = 0;     ///< Number of points that were followed.
  PlanePoint crop;            ///< Pixel of the aligned plane that became the first.

  /// The pixel of the rectified center view that shows a place of its photograph.
  [[nodiscard]] PlanePoint center_pixel(const LensCamera& camera,
                                        const PlanePoint& photograph) const;
};

/// Rectifies photographs of a camera that was moved on a grid: without lens distortion, rows and
/// columns aligned, of unchanged pixel size, on the largest common rectangle, shifted so that the
/// median disparity is 0; each sample is interpolated once (Lanczos). `photographs`: in canonical
/// order of views. The camera grid of the result has its pinhole, dH = step, focalLength in px.
/// Throws InvalidInput if the camera is of another picture size, if the views do not fit a grid or
/// overlap too little; Cancelled.
[[nodiscard]] Rectified rectify(const LightField& photographs, const LensCamera& camera,
                                const RectifyOptions& options, const Progress& progress);

/// The place on a photograph that pixel (x, y) of a rectified view shows.
class RectifyingMap {
 public:
  /// `crop`: pixel of the aligned plane that is the first of the result; `shift` in px per view
  /// step.
  RectifyingMap(const Alignment& alignment, const LensCamera& camera, GridShape grid,
                PlanePoint crop, double shift)
      : alignment_(alignment), camera_(camera), grid_(grid), crop_(crop), shift_(shift) {}

  [[nodiscard]] PlanePoint photograph(ViewIndex view, double x, double y) const;
  /// The inverse, to about 1e-4 px.
  [[nodiscard]] PlanePoint rectified(ViewIndex view, const PlanePoint& photograph) const;

 private:
  [[nodiscard]] const ViewCorrection& correction(ViewIndex view) const {
    return alignment_.corrections[static_cast<std::size_t>(view.v) * grid_.u + view.u];
  }

  const Alignment& alignment_;
  const LensCamera& camera_;
  GridShape grid_;
  PlanePoint crop_;
  double shift_;
};

}  // namespace episcope::capture
