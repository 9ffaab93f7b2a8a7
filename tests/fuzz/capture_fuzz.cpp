// SPDX-License-Identifier: BSD-3-Clause
#include "engine/capture/camera.h"
#include "engine/capture/solve_pose.h"
#include "tests/fuzz/harness.h"

#include <vector>

namespace episcope::fuzz {
namespace {

void write_seeds(const std::filesystem::path& folder) {
  const std::vector<capture::PointPair> pairs{{"a", 1, 2, {3, 4, 5}}, {"b", 6, 7, {8, 9, 10}}};
  capture::write_pairs(folder / "pairs.csv", pairs);
  capture::PoseStory story;
  story.mesh = folder / "mesh.ply";
  story.solved.pose.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  capture::write_pose(folder / "pose.json", story);
  capture::LensCamera camera;
  camera.width = camera.height = 100;
  camera.focal_x = camera.focal_y = 50;
  capture::write_camera(folder / "camera.yml", camera);
}

/// The small files of a capture: picked pairs, a pose, a camera.
void read(const std::filesystem::path& file) {
  tolerate([&] { (void)capture::read_pairs(file); });
  tolerate([&] { (void)capture::read_pose(file); });
  (void)capture::read_camera(file);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("file"); }, read, write_seeds};

}  // namespace episcope::fuzz
