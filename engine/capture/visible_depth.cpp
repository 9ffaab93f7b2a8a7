// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/visible_depth.h"

#include "engine/capture/pixel_surface.h"
#include "engine/core/error.h"

#include <algorithm>

namespace episcope::capture {
namespace {

void write_view(const ViewSurface& surface, const PlacedScene& scene, const CameraGrid& camera,
                ViewIndex view, GroundTruth& truth) {
  const ImageView<float> disparity = truth.field.disparity.view(view);
  const ImageView<std::uint8_t> valid = truth.field.valid.view(view);
  const ImageView<std::int32_t> labels = truth.labels.view(view);
  const double scale = camera.baseline * camera.focal_length;
  for (int y = 0; y < disparity.height; ++y) {
    for (int x = 0; x < disparity.width; ++x) {
      const std::uint32_t face = surface.triangle.at(y, x);
      const double w = surface.inverse_depth.at(y, x);
      const bool is_seen = surface.state.at(y, x) == ViewSurface::Seen;
      disparity.at(y, x) = is_seen ? static_cast<float>(scale * w - camera.shift) : 0.0F;
      valid.at(y, x) = is_seen ? 1 : 0;
      labels.at(y, x) = face == PixelSurface::kNone ? 0 : scene.mesh_of(face) + 1;
    }
  }
}

/// Wrong poses and wrong orientation are told from the center view.
void require_seen(const ViewSurface& surface) {
  const auto count = [&](ViewSurface::State state) {
    return std::ranges::count(surface.state, static_cast<std::uint8_t>(state));
  };
  const auto seen = count(ViewSurface::Seen);
  const auto unsure = count(ViewSurface::Unsure);
  if (seen + unsure == 0) {
    throw InvalidInput(
        "the meshes are not in the picture of the center view; check their poses, and that pose "
        "and light field are in the same unit");
  }
  if (unsure > 3 * seen) {
    throw InvalidInput(
        "the center view sees the meshes from inside (" + std::to_string(unsure) + " of " +
        std::to_string(seen + unsure) +
        " pixels): their faces are wound the wrong way; turn them, or use --both-sides");
  }
}

}  // namespace

ViewCamera view_camera(const DepthGrid& grid, ViewIndex view) {
  const ViewIndex center = grid.grid.center();
  const double u = view.u - center.u;
  const double v = view.v - center.v;
  const CameraGrid& camera = grid.camera;
  return {*camera.pinhole,  camera.baseline * u, camera.baseline * v, camera.shift * u,
          camera.shift * v, grid.height,         grid.width};
}

GroundTruth visible_depth(std::span<const PlacedMesh> meshes, const DepthGrid& grid,
                          const DepthOptions& options, const Progress& progress) {
  const CameraGrid& camera = grid.camera;
  if (!camera.pinhole || !camera.is_known()) {
    throw InvalidInput(
        "the pinhole of this light field and the step of its grid are not known; make it with "
        "episcope-cli rectify --step");
  }
  const PlacedScene scene = place(meshes, progress.part(0, 0.02));
  ViewRaster raster(scene, options.jump_px / (camera.baseline * camera.focal_length),
                    options.both_sides);
  const ViewIndex center = grid.grid.center();
  const GridShape shape = grid.grid;
  GroundTruth truth;
  truth.field.disparity = ViewStack<float>(shape, grid.height, grid.width);
  truth.field.valid = ViewStack<std::uint8_t>(shape, grid.height, grid.width);
  truth.labels = ViewStack<std::int32_t>(shape, grid.height, grid.width);
  require_seen(raster.view(view_camera(grid, center), progress.part(0.02, 0.03)));
  for (int i = 0; i < shape.count(); ++i) {
    const ViewIndex view = shape.view_at(i);
    progress.step("depth of view " + view_text(view));
    const double begin = 0.03 + 0.97 * i / shape.count();
    const ViewSurface surface =
        raster.view(view_camera(grid, view), progress.part(begin, begin + 0.97 / shape.count()));
    write_view(surface, scene, camera, view, truth);
  }
  return truth;
}

}  // namespace episcope::capture
