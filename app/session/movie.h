// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/picture.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"
#include "engine/render/movie.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace episcope {

/// What a movie is made from.
struct MovieSubject {
  MapSource source;                  ///< The map, as it stands in the view that is shown.
  std::optional<MapSource> other{};  ///< Of a flip.
  const Scene* scene = nullptr;      ///< Judges errors in other views; outlives the movie.
  /// Draws a map, or the view of the light field; for any thread.
  std::function<RgbaImage(const MapSource&)> draw;
  const render::ToneTable* tone = nullptr;  ///< Of refocused views; outlives the movie.
};

/// Pictures of one size, made when they are asked for.
struct Movie {
  int count = 0;
  double rate = 10;  ///< Pictures per second.
  std::function<RgbaImage(int)> picture;
};

/// A parallax skips views without the map. Throws InvalidInput if all along the path do, if no view
/// is refocused or if `other` is missing.
[[nodiscard]] Movie make_movie(const render::MovieChoice& choice, const MovieSubject& subject);

/// Makes the pictures and writes them. Throws what io::MovieFile does, Cancelled.
void write_movie(const std::filesystem::path& path, const Movie& movie, int width_px,
                 const Progress& progress);

}  // namespace episcope
