// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/project/session_project.h"

namespace episcope {
namespace {

ProjectResult result_of(const EstimateEntry& entry) {
  return {.name = entry.name,
          .file = entry.kept,
          .display_range = entry.display_range,
          .note = entry.note,
          .id = entry.id,
          .estimate = entry.estimate};
}

ProjectScene project_scene_of(const OpenScene& open) {
  ProjectScene scene{.name = open.name,
                     .input = open.input,
                     .sample_hash = open.sample_hash,
                     .reading = open.reading,
                     .place = open.place,
                     .id = open.id,
                     .results = {},
                     .strokes = open.unread_strokes,
                     .unread_strokes = open.unread_strokes,
                     .labels = open.labels};
  for (const EstimateEntry& entry : open.estimates) {
    ProjectResult result = result_of(entry);
    result.is_shown = entry.id == open.shown;
    result.is_compared = entry.id == open.compared && open.is_compared_chosen;
    scene.results.push_back(std::move(result));
  }
  for (const EstimateEntry& entry : open.unread) {
    if (entry.kept.empty()) continue;
    scene.results.push_back(result_of(entry));
    scene.results.back().is_unread = true;
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
