// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/scenes/builtin.h"

namespace episcope::scenes {

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
/// (of a scene that is drawn, and of noise), kind (of a random scene: random_kind_names()), size
/// (px, "256" or "320x240" for width and height), grid ("9x9", rows and columns of views), noise
/// (in units of 1/255) and channels (3, or 1 for gray). Throws Unavailable for an unknown scene and
/// InvalidInput for a query that is not of this form; the message says what is possible.
[[nodiscard]] BuiltinRequest read_request(const std::string& text);

/// What stands behind the '?' of such a text, into the options of `request`; others stay as they
/// are. Throws InvalidInput likewise.
void read_options(const std::string& text, BuiltinRequest& request);

}  // namespace episcope::scenes
