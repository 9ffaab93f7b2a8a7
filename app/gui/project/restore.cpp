// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/project/restore.h"

#include "app/gui/document/document_controller.h"
#include "app/gui/frame/jobs.h"
#include "app/gui/frame/messages.h"
#include "app/gui/opening/scene_switcher.h"
#include "app/session/project/session_project.h"
#include "app/session/scene/load_scene.h"
#include "engine/core/error.h"

#include <algorithm>
#include <utility>

namespace episcope {

void read_strokes(ReadProject& read) {
  for (std::size_t i = 0; i < read.project.scenes.size(); ++i) {
    const std::filesystem::path& file = read.project.scenes[i].strokes;
    if (file.empty()) continue;
    try {
      read.strokes.emplace(i, read_journal(file));
    } catch (const IoError& error) {
      read.failures << QString::fromUtf8(error.what());
    }
  }
}

namespace {

// A built-in scene is what a start without a file shows.
bool gives_way(const OpenScene& open, const Project& project) {
  return !builtin_scene_id(open.input).empty() ||
         std::ranges::count(project.scenes, open.input, &ProjectScene::input) > 0;
}

void make_way(const Workbench& bench, const Project& project, ProjectOrigin origin) {
  bench.jobs.cancelLane(Lane::Open);
  for (const OpenScene* each : bench.session.scenes()) {
    if (origin == ProjectOrigin::Crash && !gives_way(*each, project)) continue;
    const std::uint64_t id = each->id;
    id == bench.session.generation() ? bench.session.close() : bench.session.remove(id);
  }
}

}  // namespace

std::vector<std::filesystem::path> show_project(const Workbench& bench, ReadProject read,
                                                ProjectOrigin origin) {
  const bool is_saved = origin == ProjectOrigin::File;
  make_way(bench, read.project, origin);
  bench.session.set_bad_threshold(read.project.bad_threshold_px);
  std::uint64_t current = 0;
  std::vector<std::filesystem::path> kept;
  std::map<std::uint64_t, std::uint64_t> ids;  // of scenes: those of the project, those of now
  for (std::size_t i = 0; i < read.project.scenes.size(); ++i) {
    const ProjectScene& scene = read.project.scenes[i];
    const std::uint64_t id = bench.session.add_aside(scene_of(scene, is_saved));
    ids[scene.id] = id;
    if (i <= read.project.current) current = id;
    const auto strokes = read.strokes.find(i);
    if (strokes == read.strokes.end()) {
      bench.session.set_unread_strokes(id, scene.strokes);
      continue;
    }
    strokes->second.owner.source = scene.input;
    const auto stored = is_saved ? scene.strokes : std::filesystem::path();
    if (bench.document.bring(id, std::move(strokes->second), stored)) kept.push_back(scene.strokes);
  }
  for (Sweep& sweep : read.project.sweeps) {
    for (SweepScene& scene : sweep.scenes) scene.scene = ids[scene.scene];
    sweep.is_saved = is_saved;
    bench.scenes.sweeps().add(std::move(sweep));
  }
  if (!read.failures.isEmpty()) bench.messages.warn(read.failures.join(' '));
  bench.scenes.show(current);
  return kept;
}

}  // namespace episcope
