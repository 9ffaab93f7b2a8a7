// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/project_file.h"
#include "tests/fuzz/harness.h"

namespace episcope::fuzz {
namespace {

Project seed_project(const std::filesystem::path& folder) {
  ProjectScene scene;
  scene.name = "a";
  scene.input = (folder / "scenes/a.h5").string();
  scene.reading = {{"flip", std::string("u")}, {"frame", 2}};
  scene.strokes = folder / "seed_files/a.strokes";
  scene.results.push_back({.name = "EPI_S", .file = folder / "seed_files/a_EPI_S.h5"});
  scene.place.tone.gamma = 2;
  scene.place.label_marks.hidden = {1, 2};
  scene.place.capture.mesh = (folder / "mesh.ply").string();
  scene.place.capture.pairs = {{"p", 1, 2, {3, 4, 5}}};
  scene.place.measured.list.push_back({.name = "line"});
  scene.place.comparison.shows_difference = true;
  Project project;
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
