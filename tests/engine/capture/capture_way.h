// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"
#include "engine/capture/rectify.h"
#include "engine/capture/solve_pose.h"
#include "engine/capture/view_surface.h"

#include <optional>

namespace episcope::accuracy {

/// The whole way from photographs of a gantry to ground truth, on the synthesized gantry of
/// engine/capture/demo: photographs of a pattern and of the scan, calibration, rectification with
/// gains evened, pose from noisy picks, depth of all views. Only the scan is known to the steps.
struct CaptureWay {
  capture::DemoOptions options;
  capture::DemoRig rig;  ///< The truth.
  capture::TriangleMesh mesh;
  capture::Calibration calibration;
  capture::Rectified rectified;
  capture::SolvedPose pose;
  capture::DepthGrid cameras;
  GroundTruth truth;  ///< As the way found it.
};

/// Throws what the steps throw; Cancelled.
[[nodiscard]] CaptureWay go_capture_way(const capture::DemoOptions& options,
                                        const Progress& progress);

/// What the true camera of the center sees at pixels of the rectified center view, by rays that
/// share nothing with the rasterizer. `way` must outlive it.
class ExactCenter {
 public:
  explicit ExactCenter(const CaptureWay& way);

  /// The point of the surface, in the frame of the gantry (mm); none = beside the scan.
  [[nodiscard]] std::optional<capture::Point3> point(double x, double y) const;
  /// By how much the rectified picture of a point moves for a step of the gantry, halved from both
  /// sides, px per view step: what a perfect method would measure.
  [[nodiscard]] double disparity(const capture::Point3& point) const;

 private:
  const CaptureWay& way_;
  capture::PlacedScene scene_;
  capture::RectifyingMap map_;
  capture::Exposure exposure_;
};

/// What the way got wrong.
struct CaptureErrors {
  capture::RowErrors rows_before, rows_after;
  double gain = 0;              ///< Largest error of a gain.
  double tz = 0;                ///< Of the pose, in mm,
  double delta_tz = 0;          ///< and what the way itself says of it.
  double disparity_median = 0;  ///< |disparity − exact| of unmasked pixels, px,
  double disparity_99 = 0;      ///< and what 99 % of them keep to.
  int jumps = 0;                ///< Discontinuities of more than 0.5 px along rows,
  int missed = 0;               ///< and those that are not masked.
};

/// `samples`: unmasked pixels of the center view looked at, at random places.
[[nodiscard]] CaptureErrors capture_errors(const CaptureWay& way, int samples);

}  // namespace episcope::accuracy
