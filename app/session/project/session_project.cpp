// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/session_project.h"

namespace episcope {
namespace {

ProjectScene project_scene_of(const OpenScene& open) {
  ProjectScene scene{.name = open.name,
                     .input = open.input,
                     .sample_hash = open.sample_hash,
                     .reading = open.reading,
                     .place = open.place,
                     .id = open.id,
                     .results = {},
                     .strokes = {},
                     .labels = open.labels};
  for (const EstimateEntry& entry : open.estimates) {
    scene.results.push_back({.name = entry.name,
                             .file = entry.kept,
                             .display_range = entry.display_range,
                             .is_shown = entry.id == open.shown,
                             .is_compared = entry.id == open.compared && open.is_compared_chosen,
                             .note = entry.note,
                             .id = entry.id,
                             .estimate = entry.estimate});
  }
  return scene;
}

}  // namespace

Project project_of(const Session& session) {
  Project project;
  project.bad_threshold_px = session.bad_threshold_px();
  for (const OpenScene* each : session.scenes()) {
    if (each->id == session.generation()) project.current = project.scenes.size();
    project.scenes.push_back(project_scene_of(*each));
  }
  return project;
}

OpenScene scene_of(const ProjectScene& scene, bool is_saved) {
  OpenScene open;
  open.name = scene.name;
  open.input = scene.input;
  open.reading = scene.reading;
  open.sample_hash = scene.sample_hash;
  open.place = scene.place;
  open.labels = scene.labels;
  int id = 0;
  for (const ProjectResult& result : scene.results) {
    open.estimates.push_back({.id = ++id,
                              .name = result.name,
                              .estimate = nullptr,
                              .display_range = result.display_range,
                              .is_saved = is_saved,
                              .kept = result.file,
                              .note = result.note});
    if (result.is_shown) open.shown = id;
    if (result.is_compared) {
      open.compared = id;
      open.is_compared_chosen = true;
    }
  }
  return open;
}

}  // namespace episcope
