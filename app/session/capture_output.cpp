// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture_output.h"

#include "engine/capture/visible_depth.h"
#include "engine/io/formats/write_scene.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>
#include <vector>

namespace episcope {
namespace {

GroundTruth depth_of(std::span<const PosedMesh> meshes, const LightField& field, GridShape grid,
                     const Progress& progress) {
  std::vector<capture::PlacedMesh> placed;
  for (const PosedMesh& each : meshes) placed.push_back({each.mesh.get(), each.pose});
  const capture::DepthGrid cameras{grid, field.height(), field.width(), field.info().camera};
  return capture::visible_depth(placed, cameras, {}, progress);
}

// The only view of a stack, as view `index` of a light field.
template <class T>
ViewStack<T> as_view(const ViewStack<T>& only, ViewIndex index) {
  ViewStack<T> placed({1, 1}, only.height(), only.width(), only.channels(), index);
  std::copy_n(only.data(), only.size(), placed.data());
  return placed;
}

}  // namespace

Estimate mesh_estimate(std::span<const PosedMesh> meshes, const Scene& scene,
                       const Progress& progress) {
  const auto begin = std::chrono::steady_clock::now();
  const LightField& field = *scene.light_field;
  const GroundTruth truth = depth_of(meshes, field, {1, 1}, progress);
  Estimate estimate;
  estimate.method = "mesh";
  estimate.source = field.info().source;
  estimate.reading = field.info().reading;
  estimate.field.disparity = as_view(truth.field.disparity, field.center());
  estimate.field.valid = as_view(truth.field.valid, field.center());
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  estimate.seconds = took.count();
  return estimate;
}

Scene with_mesh_truth(std::span<const PosedMesh> meshes, const Scene& scene,
                      const Progress& progress) {
  Scene made = scene;
  made.truth = std::make_shared<GroundTruth>(
      depth_of(meshes, *scene.light_field, scene.light_field->grid(), progress));
  return made;
}

RectifiedFile rectify_to_file(RectifyTask task, const Progress& progress) {
  const capture::LensCamera& camera = task.work.lens->camera;
  RectifiedFile made{capture::rectify(*task.photographs.light_field, camera, task.work.rectify,
                                      progress.part(0, 0.9)),
                     task.work};
  Scene scene = std::move(task.photographs);
  scene.light_field = made.rectified.light_field;
  scene.truth = std::make_shared<GroundTruth>();
  scene.scribbles = {};
  io::write_archive(task.output, scene, progress.part(0.9, 1));
  made.work.rows = {made.rectified.before, made.rectified.after};
  for (CaptureObject& object : made.work.objects) {
    object.pose.reset();
    for (capture::PointPair& pair : object.pairs) {
      const capture::PlanePoint place = made.rectified.center_pixel(camera, {pair.x_px, pair.y_px});
      pair.x_px = place.x;
      pair.y_px = place.y;
    }
  }
  return made;
}

}  // namespace episcope
