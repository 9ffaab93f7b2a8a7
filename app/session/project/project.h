// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/open_scene.h"
#include "app/session/sweep/sweep.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace episcope {

/// A result of a project.
struct ProjectResult {
  std::string name;            ///< As the user calls it.
  std::filesystem::path file;  ///< That holds it; empty = none does yet.
  Interval display_range{};    ///< EstimateEntry::display_range.
  bool is_shown = false;
  bool is_compared = false;
  std::string note{};      ///< EstimateEntry::note.
  int id = 0;              ///< EstimateEntry::id. Not part of a project file, as what follows.
  bool is_unread = false;  ///< In OpenScene::unread.
  /// In memory; null if it is in its file only.
  EstimatePtr estimate{};
};

/// A light field of a project with what was found and drawn on it.
struct ProjectScene {
  std::string name;               ///< Of the light field.
  std::string input;              ///< What opens it: a path, or a built-in scene.
  std::uint64_t sample_hash = 0;  ///< LightField::sample_hash; 0 = unknown.
  ParameterSet reading;           ///< Options that it was read with (io::open_schema).
  ScenePlace place;
  /// OpenScene::id; of a project that was read, its place in the list, from 1.
  std::uint64_t id = 0;
  std::vector<ProjectResult> results;
  std::filesystem::path strokes;  ///< Journal of what was painted; empty = nothing was.
  /// OpenScene::unread_strokes, whatever is painted now. Not part of a project file.
  std::filesystem::path unread_strokes{};
  KeptLabels labels{};  ///< In memory only while the program runs.
};

/// What a project file holds.
struct Project {
  std::vector<ProjectScene> scenes;
  std::size_t current = 0;  ///< The one that is shown.
  double bad_threshold_px = kBadPixelThreshold_px;
  std::vector<Sweep> sweeps{};     ///< Their scenes are named by ProjectScene::id.
  std::filesystem::path saved_as;  ///< Of a workspace: the user's own file of it; empty = none yet.
};

}  // namespace episcope
