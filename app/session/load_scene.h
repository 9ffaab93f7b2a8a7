// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/user_folders.h"
#include "engine/capture/calibrate.h"
#include "engine/capture/demo_folder.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/io/models/open_options.h"
#include "engine/scenes/builtin.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

struct LoadOptions {
  io::OpenOptions open;
  /// Folder that keeps built-in scenes once they were rendered; empty = none is kept.
  std::filesystem::path cache_folder;
  /// Whether truth and labels are wanted. Without, kept built-in scenes are read in a fraction of
  /// the memory; other inputs may need their truth to settle the order of views.
  bool needs_truth = true;
};

/// A copy of a light field with other facts.
[[nodiscard]] LightFieldPtr with_info(const LightField& light_field, LightFieldInfo info);

/// What follows `demo:` if `input` is `demo`, `demo?<options>` (the scene `demo` with options) or
/// `demo:<scene>`, which `scenes::read_request` reads; else empty.
[[nodiscard]] std::string builtin_scene_id(const std::string& input);

/// Id of the reader of an input (engine/io/models/reader.h), or of the only light field below it,
/// which load_scene opens; "builtin" for built-in scenes; empty if nobody reads it. Throws IoError
/// if it is not there or damaged.
[[nodiscard]] std::string reader_of(const std::string& input, const io::OpenOptions& options);

/// Opens anything that a user can name: `demo`, `demo:<scene>`, `demo:random?seed=7`, or a path
/// that `io::open_scene` opens, or a container of a Lytro camera: its raw picture is decoded with
/// the white picture in it or beside it, a processed one is a single view. The light field's
/// `source` is what opens it again. A built-in scene is read from the cache where it is there and
/// whole, else rendered; `store_in_cache` keeps it for the next time, but for the gantry, which is
/// kept at once. Throws IoError, IsCollection for a folder of several light fields, Unavailable for
/// an unknown built-in scene, InvalidInput for what cannot be read behind its '?', Cancelled.
[[nodiscard]] Scene load_scene(const std::string& input, const LoadOptions& options,
                               const Progress& progress);

/// Keeps a built-in scene that `load_scene` rendered. Does nothing for other inputs, for a scene
/// that is random, has options, is kept already or has a focus plane baked in, without a cache
/// folder, or where that cannot be written: a cache is a convenience. Throws Cancelled.
void store_in_cache(const std::string& input, const Scene& scene,
                    const std::filesystem::path& cache_folder, const Progress& progress);

/// `load_scene` with the user's cache, which keeps the built-in scene for the next time; reading
/// options that the form of the input does not have are named in warnings. Throws likewise.
[[nodiscard]] Scene open_input(const std::string& input, io::OpenOptions open, bool needs_truth,
                               const Progress& progress);

/// All that can follow `demo:`: the built-in scenes, which have ground truth, and the gantry and
/// the plenoptic camera, before the random one.
[[nodiscard]] std::vector<scenes::BuiltinSceneInfo> builtin_inputs();

/// Throws Unavailable for an unknown scene, naming the nearest and all, and InvalidInput for
/// options that cannot be read. `id`: what follows `demo:`.
void require_builtin_input(const std::string& id);

/// Name of an input for lists and files (scenes::builtin_name). Throws as `require_builtin_input`.
[[nodiscard]] std::string builtin_input_name(const std::string& id);

/// Built-in scenes kept on disk in archive form, one folder for each scene, version and options.
class SceneCache {
 public:
  /// An empty folder keeps nothing.
  explicit SceneCache(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Where a scene is kept.
  [[nodiscard]] std::filesystem::path place(const std::string& id,
                                            const scenes::RenderOptions& options) const;
  /// Empty if the scene is not there. One that cannot be read is removed. `needs_truth`: as of
  /// LoadOptions. Throws Cancelled.
  [[nodiscard]] std::optional<Scene> read(const std::string& id,
                                          const scenes::RenderOptions& options, bool needs_truth,
                                          const Progress& progress) const;
  /// Returns whether the scene is kept now. What cannot be written is not kept. Throws Cancelled.
  bool write(const std::string& id, const scenes::RenderOptions& options, const Scene& scene,
             const Progress& progress) const;

 private:
  std::filesystem::path folder_;
};

/// Id of the synthetic gantry, `demo:gantry`: a light field of photographs that are not rectified.
inline constexpr const char* kGantryScene = "gantry";

/// Whether what follows `demo:` is the gantry, with options or without.
[[nodiscard]] bool is_gantry(const std::string& id);

/// Options as of other built-in scenes: seed, size, grid, noise. Throws InvalidInput.
[[nodiscard]] capture::DemoOptions gantry_options(const std::string& id);

/// Files of the gantry, in a folder of the cache.
struct GantryFolder {
  std::filesystem::path path;

  [[nodiscard]] std::filesystem::path photographs() const { return path / "photographs"; }
  /// Of the calibration pattern (capture::demo_pattern), by name.
  [[nodiscard]] std::vector<std::filesystem::path> pattern() const;
  [[nodiscard]] std::filesystem::path mesh() const { return path / "mesh.ply"; }
  /// Points that were picked in the photograph of the center.
  [[nodiscard]] std::filesystem::path picks() const { return path / "picks.csv"; }
};

/// The folder that an input belongs to: the folder of `demo:gantry`, or the one that a file lies
/// in. None for other inputs and missing folders.
[[nodiscard]] std::optional<GantryFolder> gantry_folder(const std::string& input,
                                                        const std::filesystem::path& cache_folder);

/// Reads the photographs from the cache, or makes them and keeps them there with pattern, mesh and
/// picks. Without a writable cache folder, makes the photographs only. The center view is shown
/// first. Throws InvalidInput, Cancelled.
[[nodiscard]] Scene load_gantry(const std::string& id, const LoadOptions& options,
                                const Progress& progress);

}  // namespace episcope
