// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope::io {

using Direction = std::array<double, 3>;

[[nodiscard]] inline double dot(const Direction& a, const Direction& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
[[nodiscard]] inline Direction times(double factor, const Direction& a) {
  return {factor * a[0], factor * a[1], factor * a[2]};
}

/// Scales a vector to the length 1.
[[nodiscard]] inline Direction normalized(const Direction& a) {
  return times(1 / std::sqrt(dot(a, a)), a);
}

/// Position of a camera in coordinates of the scene, and its directions right, down and ahead:
/// vectors of length 1.
struct CameraPose {
  std::string image;  ///< Name of its file, as its file of poses states it; maybe without suffix.
  std::array<double, 3> center{};
  Direction right{};
  Direction down{};
  Direction ahead{};
  double focal_widths = 0;  ///< Focal length in widths of the image; 0 = not stated.

  [[nodiscard]] bool is_finite() const {
    for (const auto& vector : {center, right, down, ahead}) {
      for (const double value : vector) {
        if (!std::isfinite(value)) return false;
      }
    }
    return true;
  }
};

/// Poses of COLMAP's `images.bin`, which holds what `images.txt` does, in little
/// endian. Focal lengths come from `cameras.bin` beside it, if it is there. Takes no more memory
/// than a few times the file. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_binary_colmap_poses(const std::filesystem::path& path);

/// Poses of COLMAP's `images.txt`, of which every second line is one: id, a quaternion (w, x, y, z)
/// and a translation from the scene to the camera, whose y is down and z ahead, the id of the
/// camera, and the name of the image. Focal lengths come from `cameras.txt` beside it, if it is
/// there. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_colmap_poses(const std::filesystem::path& path);

/// Poses of images, and their files.
struct FoundPoses {
  std::vector<std::filesystem::path> files;   ///< That hold the poses.
  std::vector<CameraPose> poses;              ///< Of `images`, in their order.
  std::vector<std::filesystem::path> images;  ///< Those that the files know.
  std::string problem;                        ///< Why they cannot be used; empty if they can.
};

/// Finds camera poses: `transforms.json` (NeRF), `poses_bounds.npy` (LLFF), `images.bin` or
/// `images.txt` with cameras (COLMAP). Looks in a folder of images, in the folder of the scene
/// around it, beside a folder `images` around both, and in `sparse/0`, `sparse` and `colmap` of
/// these; reads the first form found. Images are known by their names, with as many folders and
/// regardless of case as needed.
/// `images` are sorted by name. If poses are split for training and testing
/// (`transforms_train.json`), all of them come first, then each part. Empty if there are none.
[[nodiscard]] std::vector<FoundPoses> find_poses(const std::filesystem::path& folder,
                                                 const std::filesystem::path& scene,
                                                 const std::vector<std::filesystem::path>& images);

/// Folders inside `folder` with the images of a training or test part each, `train`, `val`, `test`,
/// or of one camera each, below `images`. Empty if it has no such pose files.
[[nodiscard]] std::vector<std::filesystem::path> folders_of_parts(
    const std::filesystem::path& folder);

/// Marks a place without a camera in `PoseGrid::order`.
inline constexpr auto kNoCamera = static_cast<std::size_t>(-1);

/// Cameras as the grid of a light field, in canonical order.
struct PoseGrid {
  GridShape grid{};
  std::vector<std::size_t> order{};         ///< Of the poses, row by row; `kNoCamera` in gaps.
  std::vector<CameraPosition> positions{};  ///< Row by row: right and down in the cameras' view.
  double step = 0;  ///< Of neighbors in a row, or in the only column, in units of the scene.
  double focal_widths = 0;  ///< 0 = not stated.
  std::string evidence{};   ///< "cameras in steps of 0.1, turned by 0.01° at most, …".
  std::string problem{};    ///< Why they are no such grid, as a clause; empty if they are.
};

/// Arranges cameras on the grid of a light field: rows and columns along what they see as down and
/// right. Orientations may differ by 0.5°, places by a tenth of a step. O(N log N).
[[nodiscard]] PoseGrid find_pose_grid(const std::vector<CameraPose>& poses);

}  // namespace episcope::io
