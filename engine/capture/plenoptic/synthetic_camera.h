// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/capture/plenoptic/lens_grid.h"
#include "engine/capture/plenoptic/raw_picture.h"
#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/core/schema.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace episcope::capture {

/// A plenoptic camera that is computed: an F01 or an Illum of Lytro, or a laboratory camera with a
/// square array.
enum class CameraModel { F01, Illum, Square };
[[nodiscard]] Names<CameraModel> names_of(CameraModel);

/// Sensor, lenses and errors of such a camera.
struct SyntheticCamera {
  CameraModel model = CameraModel::F01;
  int width = 0;
  int height = 0;
  LensLattice lattice = LensLattice::Hexagonal;
  double pitch_px = 10;
  double rotation_degrees = 0.1;
  double bend_px = 0.3;  ///< Radial distortion of the array, at the corner of the sensor.
  PlanePoint origin;     ///< Lens (0, 0), px from the middle of the sensor.
  Mosaic mosaic = Mosaic::Gray;
  Packing packing = Packing::Bits16;
  double black = 0;
  double white = 65535;
  RawColors colors{};
  double noise = 0.005;     ///< Standard deviation, in parts of the range from black to white.
  double hot_share = 2e-5;  ///< Of all pixels.
  unsigned seed = 1;

  [[nodiscard]] double row_distance_px() const;
  /// Place of a lens on the sensor, px.
  [[nodiscard]] PlanePoint center(int i, int j) const;
  /// Size of a view in pixels of one row distance (one pitch, if square), odd: all of the sensor.
  /// Lens (0, 0) sees the pixel in the middle.
  [[nodiscard]] int view_width() const;
  [[nodiscard]] int view_height() const;
};

/// The camera as its model is built.
[[nodiscard]] SyntheticCamera synthetic_camera(CameraModel model);

/// A scene as seen from these positions of the main lens, all in a row, in view steps from the
/// middle: uint8 views on a grid of one row, of the size of the camera's views, gray for a gray
/// camera; and the disparity of all of them as truth.
using PupilLight =
    std::function<Scene(const std::vector<CameraPosition>& positions, const Progress& progress)>;

/// Pictures of one exposure.
struct SyntheticPictures {
  RawPicture raw;
  RawPicture white;
  std::optional<RawPicture> dark;  ///< Of the square camera.
};

/// Exposes a sensor ray by ray: each pixel lies below the lens nearest to it, whose cell it sees
/// from a patch of the main lens; four rays of the patch are looked up in the nearest view, moved
/// by the disparity there. A view step is one pixel of the sensor. Lens, main lens and its barrel
/// shade the light. Deterministic. Throws what `light` throws, and Cancelled.
[[nodiscard]] SyntheticPictures expose(const SyntheticCamera& camera, const PupilLight& light,
                                       const Progress& progress);

/// Writes what the camera would: raw.lfp with calibration/MOD_0000.RAW … (F01), raw.lfr with its
/// white picture (Illum), or raw.png, raw_white.png and raw_dark.png, into a folder, which is made.
/// Returns the raw file. Throws IoError.
std::filesystem::path write_pictures(const std::filesystem::path& folder,
                                     const SyntheticCamera& camera,
                                     const SyntheticPictures& pictures);

}  // namespace episcope::capture
