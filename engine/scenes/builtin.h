// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/camera_grid.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/scenes/plan.h"
#include "engine/scenes/stage.h"

#include <string>
#include <vector>

namespace episcope::scenes {

struct BuiltinSceneInfo {
  std::string id;       ///< "demo", "fronto", "edge", "backgammon", "random", …
  std::string summary;  ///< One line.
};

struct RenderOptions {
  GridShape grid{9, 9};
  int height = 512;
  int width = 512;
  double noise_sigma = 0;  ///< Gaussian noise in units of 1/255.
  unsigned seed = 1;       ///< Of a scene that is drawn, and of the noise.
  int channels = 3;
  /// Scales every disparity, to make scenes of wider or narrower range.
  double disparity_scale = 1;
  /// Positions of the cameras, in steps to the right of and below the center view, view by view;
  /// empty = on the regular grid. They become LightFieldInfo::positions; the center view must stand
  /// at (0, 0).
  std::vector<CameraPosition> positions{};
  RandomKind kind = RandomKind::Any;  ///< Of a random scene.
  friend bool operator==(const RenderOptions&, const RenderOptions&) = default;
};

/// The scene that is drawn from `RenderOptions::seed`.
inline constexpr const char* kRandomScene = "random";

/// Reader of built-in scenes in LightFieldInfo::reading.
inline constexpr const char* kBuiltinReader = "builtin";

/// All built-in scenes: the demo, simple ones that each test one thing, stratified ones, and the
/// random one.
[[nodiscard]] std::vector<BuiltinSceneInfo> builtin_scenes();

/// Whether the seed decides how the scene looks: the random one and the stratified ones.
[[nodiscard]] bool is_drawn(const std::string& id);

/// Name for lists and files: the id; of a scene that is drawn with its seed, of a random one with
/// its kind as well ("dots_3", "random_thin_7").
[[nodiscard]] std::string builtin_name(const std::string& id, const RenderOptions& options);

/// How users write the scene (read_request): the id; of a drawn scene with seed, and kind if it has
/// one
/// ("random?seed=7&kind=thin").
[[nodiscard]] std::string builtin_text(const std::string& id, const RenderOptions& options);

/// Ray-casts a built-in scene analytically, each view by itself: exact disparity and labels at
/// pixel centers for every view, color averaged over 4×4 samples, band-limited textures, seeded
/// noise. Deterministic: the same options give the same bytes on every machine and thread count.
/// `id` is a scene alone (read_request reads queries).
/// Throws Unavailable for an unknown id (naming the nearest), InvalidInput, Cancelled.
[[nodiscard]] Scene render_builtin(const std::string& id, const RenderOptions& options,
                                   const Progress& progress);

/// A built-in scene as users write it.
struct BuiltinRequest {
  std::string scene;
  RenderOptions options;

  /// Whether anything but the scene was said.
  [[nodiscard]] bool is_plain() const { return options == RenderOptions(); }
  /// See builtin_name.
  [[nodiscard]] std::string name() const { return builtin_name(scene, options); }
};

/// Reads "<scene>" or "<scene>?key=value&key=value", e.g. "random?seed=7&kind=thin". Keys: seed
/// (of a scene that is drawn, and of noise), kind (of a random scene: names_of(RandomKind)), size
/// (px, "256" or "320x240" for width and height), grid ("9x9", rows and columns of views), noise
/// (in units of 1/255) and channels (3, or 1 for gray). Throws Unavailable for an unknown scene and
/// InvalidInput for a query that is not of this form; the message says what is possible.
[[nodiscard]] BuiltinRequest read_request(const std::string& text);

/// Reads the part of such a text behind the '?' into the options of `request`; others stay. Throws
/// InvalidInput likewise.
void read_options(const std::string& text, BuiltinRequest& request);

/// Samples and truth of every view. `info` and scribbles are left to the caller.
struct Cast {
  ViewStack<std::uint8_t> samples;
  GroundTruth truth;
};

/// Throws Cancelled.
[[nodiscard]] Cast cast_views(const Stage& stage, const Model& model, const RenderOptions& options,
                              const Progress& progress);

}  // namespace episcope::scenes
