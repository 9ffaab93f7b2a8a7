// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/capture/mesh_truth.h"

#include "engine/capture/depth/visible_depth.h"

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

}  // namespace episcope
