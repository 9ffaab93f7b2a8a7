// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/scene/user_folders.h"
#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open_options.h"

#include <filesystem>
#include <string>

namespace episcope {

struct LoadOptions {
  io::OpenOptions open;
  /// Folder that keeps built-in scenes once they were rendered; empty = none is kept.
  std::filesystem::path cache_folder;
  /// Whether truth and labels are wanted. Without, kept built-in scenes are read in a fraction of
  /// the memory; other inputs may need their truth to settle the order of views.
  bool needs_truth = true;
};

/// What follows `demo:` if `input` is `demo`, `demo?<options>` (the scene `demo` with options) or
/// `demo:<scene>`, which `scenes::read_request` reads; else empty.
[[nodiscard]] std::string builtin_scene_id(const std::string& input);

/// Id of the reader of an input (engine/io/open/reader.h), "builtin" for built-in scenes; empty if
/// nobody reads it. Throws IoError if it is not there or damaged.
[[nodiscard]] std::string reader_of(const std::string& input, const io::OpenOptions& options);

/// Opens anything that a user can name: `demo`, `demo:<scene>`, `demo:random?seed=7`, or a path
/// that `io::open_scene` opens. The light field's `source` is what opens it again. A built-in scene
/// is read from the cache where it is there and whole, else rendered; `store_in_cache` keeps it for
/// the next time, but for the gantry, which is kept at once (gantry_scene.h). Throws IoError,
/// IsCollection for a folder of several light fields, Unavailable for an unknown built-in scene,
/// InvalidInput for what cannot be read behind its '?', Cancelled.
[[nodiscard]] Scene load_scene(const std::string& input, const LoadOptions& options,
                               const Progress& progress);

/// Keeps a built-in scene that `load_scene` rendered. Does nothing for other inputs, for a scene
/// that is random, has options, is kept already or has a focus plane baked in, without a cache
/// folder, or where that cannot be written: a cache is a convenience. Throws Cancelled.
void store_in_cache(const std::string& input, const Scene& scene,
                    const std::filesystem::path& cache_folder, const Progress& progress);

}  // namespace episcope
