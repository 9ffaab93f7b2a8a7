// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
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

/// With the length 1.
[[nodiscard]] inline Direction normalized(const Direction& a) {
  return times(1 / std::sqrt(dot(a, a)), a);
}

/// Where a camera stood, in the coordinates of the scene, and what it saw as right, down and ahead:
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

inline constexpr std::uintmax_t kLargestColmap = 1'000'000'000;  ///< In bytes: with all points.

/// The pose that COLMAP states as a quaternion (w, x, y, z), which has not to be normalised, and a
/// translation, both from the scene to the camera, whose y is down and z ahead.
[[nodiscard]] inline CameraPose colmap_pose(const std::array<double, 7>& numbers) {
  const auto [w, x, y, z, tx, ty, tz] = numbers;
  const double n = 2 / (w * w + x * x + y * y + z * z);
  CameraPose pose{.image = {},
                  .right = {1 - n * (y * y + z * z), n * (x * y - z * w), n * (x * z + y * w)},
                  .down = {n * (x * y + z * w), 1 - n * (x * x + z * z), n * (y * z - x * w)},
                  .ahead = {n * (x * z - y * w), n * (y * z + x * w), 1 - n * (x * x + y * y)}};
  for (std::size_t i = 0; i < 3; ++i) {
    pose.center[i] = -(pose.right[i] * tx + pose.down[i] * ty + pose.ahead[i] * tz);
  }
  return pose;
}

/// Poses of COLMAP's `images.txt`, of which every second line is one: id, a quaternion (w, x, y, z)
/// and a translation from the scene to the camera, whose y is down and z ahead, the id of the
/// camera, and the name of the image. Focal lengths come from `cameras.txt` beside it, if it is
/// there. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_colmap_poses(const std::filesystem::path& path);

/// Poses of `poses_bounds.npy`, N×17: for each image, in the order of names, a 3×5 matrix whose
/// columns are down, right, backwards, the place of the camera, and height, width and focal length
/// in px; then two bounds of depth, which are not used. Images are not named. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_llff_poses(const std::filesystem::path& path);

/// Poses of `transforms.json`: `frames` with `file_path` and `transform_matrix`, 4×4, from the
/// camera, whose x is right, y up and z backwards, to the scene. Focal length by `camera_angle_x`,
/// or `fl_x` and `w`. Throws IoError.
[[nodiscard]] std::vector<CameraPose> read_nerf_poses(const std::filesystem::path& path);

/// Poses of images, and where from.
struct FoundPoses {
  std::vector<std::filesystem::path> files;   ///< That hold the poses.
  std::vector<CameraPose> poses;              ///< Of `images`, in their order.
  std::vector<std::filesystem::path> images;  ///< Those that the files know.
  std::string problem;                        ///< Why they cannot be used; empty if they can.
};

/// Looks for files of poses in a folder of images, the folder of the scene around it, and
/// `sparse/0`, `sparse` and `colmap` in both, and reads the first form that is there. `images` are
/// sorted by name. Where poses are parted for training and testing (`transforms_train.json` and
/// others beside it), those of all parts come first, then those of each. Empty if there are none.
[[nodiscard]] std::vector<FoundPoses> find_poses(const std::filesystem::path& folder,
                                                 const std::filesystem::path& scene,
                                                 const std::vector<std::filesystem::path>& images);

/// The folders inside of `folder` that hold the images of such parts each: `train`, `val`, `test`.
/// None where it has no such files of poses.
[[nodiscard]] std::vector<std::filesystem::path> folders_of_parts(
    const std::filesystem::path& folder);

}  // namespace episcope::io
