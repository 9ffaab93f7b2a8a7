// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/camera.h"
#include "engine/capture/mesh_file.h"
#include "engine/core/camera_grid.h"
#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace episcope::capture {

/// A mesh and its pose. The mesh must outlive its users.
struct PlacedMesh {
  const TriangleMesh* mesh = nullptr;
  RigidPose pose;
};

/// Meshes as one, in the frame of the center view.
struct PlacedScene {
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
  std::vector<std::uint32_t> first_face;  ///< Of each mesh.

  /// Which mesh a face is of.
  [[nodiscard]] int mesh_of(std::uint32_t face) const;
};

[[nodiscard]] PlacedScene place(std::span<const PlacedMesh> meshes, const Progress& progress);

/// A view: a pinhole that was moved in its image plane.
struct ViewCamera {
  Pinhole pinhole;  ///< Of the center view.
  double x = 0;     ///< Place of this view, in the unit of the mesh.
  double y = 0;
  double shift_x = 0;  ///< Added to pixels, since views are shifted onto the zero plane.
  double shift_y = 0;
  int height = 0;
  int width = 0;
};

/// The visible surface of a scene in a view, pixel by pixel.
struct ViewSurface {
  enum State : std::uint8_t {
    Nothing,  ///< No triangle.
    Seen,     ///< One surface from outside, all over the pixel.
    Unsure    ///< A silhouette, a jump of the depth, a hole through which the inside is seen.
  };
  Image<std::uint32_t> triangle;  ///< That decides; PixelSurface::kNone = none.
  Image<float> inverse_depth;     ///< 1/Z of its plane at the center of the pixel,
  Image<float> by_x;              ///< and how 1/Z changes in a px.
  Image<float> by_y;
  Image<std::uint8_t> state;
};

/// Renders one view after another, reusing memory. In each pixel the triangle of the largest
/// visible area decides (pixel_surface.h). Triangles that reach behind the camera are left out.
class ViewRaster {
 public:
  /// `jump`: least difference of 1/Z across a discontinuity. `both_sides`: triangles are seen from
  /// either side, for meshes whose faces are not oriented. `scene` must outlive this.
  ViewRaster(const PlacedScene& scene, double jump, bool both_sides = false);
  ~ViewRaster();
  ViewRaster(const ViewRaster&) = delete;
  ViewRaster& operator=(const ViewRaster&) = delete;

  /// Independent of the number of threads. Throws Cancelled.
  [[nodiscard]] ViewSurface view(const ViewCamera& camera, const Progress& progress);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The cameras of a rectified light field.
struct DepthGrid {
  GridShape grid;
  int height = 0;
  int width = 0;
  CameraGrid camera;  ///< With its pinhole; `baseline` = step of the gantry in the unit of the
                      ///< mesh, `focal_length` = the pinhole's in px.
};

struct DepthOptions {
  double jump_px =
      0.1;  ///< Least difference of disparity across a discontinuity, px per view step.
  bool both_sides = false;  ///< Faces are not oriented: both sides count as outside.
};

/// The camera of one view.
[[nodiscard]] ViewCamera view_camera(const DepthGrid& grid, ViewIndex view);

/// Disparity (eq. 1) of the triangle that decides each pixel of each view, and its mesh as a label,
/// from 1 on; 0 = none. Pixels on silhouettes, on discontinuities of at least `jump_px`, at holes
/// and without a mesh are invalid. Source: [WMG13] section 3.2.1. Throws InvalidInput if the camera
/// is unknown, if no mesh is in front of it, or if almost all surfaces are seen from inside;
/// Cancelled.
[[nodiscard]] GroundTruth visible_depth(std::span<const PlacedMesh> meshes, const DepthGrid& grid,
                                        const DepthOptions& options, const Progress& progress);

}  // namespace episcope::capture
