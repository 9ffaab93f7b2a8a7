// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project_file.h"
#include "tests/fuzz/harness.h"

namespace episcope::fuzz {
namespace {

Sweep seed_sweep(const ProjectScene& scene) {
  const auto point_at = [](double inner) {
    return SweepPoint{.point = {{"inner_scale", inner}},
                      .display_range = {-1, 1},
                      .seconds = 0.5,
                      .vmv2013 = {{"mse_100", 1.5}},
                      .benchmark2016 = {{"badpix_7", 20}},
                      .change_px = 0.25};
  };
  Sweep sweep;
  sweep.base.method = "epi_s";
  sweep.swept = {{"inner_scale", {0.5, 0.8}}};
  sweep.scenes = {{scene.id, scene.name, {point_at(0.8), point_at(0.5)}}};
  return sweep;
}

Project seed_project(const std::filesystem::path& folder) {
  ProjectScene scene;
  scene.id = 1;
  scene.name = "a";
  scene.input = (folder / "scenes/a.h5").string();
  scene.reading = {{"flip", std::string("u")}, {"frame", 2}};
  scene.strokes = folder / "seed_files/a.strokes";
  scene.estimates.push_back({.name = "EPI_S",
                             .estimate = nullptr,
                             .display_range = {},
                             .kept = folder / "seed_files/a_EPI_S.h5"});
  scene.place.tone.gamma = 2;
  scene.place.label_marks.hidden = {1, 2};
  scene.place.capture.lens = CaptureLens{.camera = {64, 48, 60, 60, 32, 24, {-0.1}, 0.2},
                                         .photographs = {{"01.png", 0.2}, {"02.png", 0, "blur"}}};
  scene.place.capture.rows = RowAlignment{{0.1, 0.5}, {0.01, 0.05}};
  scene.place.capture.objects = {{.name = "head",
                                  .mesh = (folder / "mesh.ply").string(),
                                  .pairs = {{"p", 1, 2, {3, 4, 5}}},
                                  .pose = capture::SolvedPose{.pairs = {{0.5}}}}};
  scene.place.measured.list.push_back({.name = "line"});
  scene.place.comparison.shows_difference = true;
  Project project;
  project.sweeps = {seed_sweep(scene)};
  project.scenes = {scene};
  return project;
}

void write_seeds(const std::filesystem::path& folder) {
  write_project(folder / "seed.episcope", seed_project(folder));
}

void read(const std::filesystem::path& file) {
  (void)read_project(file);
}

}  // namespace

const Harness kHarness{[](std::string_view) { return std::string("work.episcope"); }, read,
                       write_seeds};

}  // namespace episcope::fuzz
