// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/input.h"
#include "app/session/quantity_map.h"
#include "engine/core/scene.h"
#include "engine/io/models/map_reading.h"

#include <optional>
#include <string>

namespace episcope::cli {

/// Kind of the subject of `show`.
enum class ShownKind { LightField, Result, Labels };

/// The map that `show` is asked for.
struct ShownMap {
  std::string subject;
  ShownKind kind = ShownKind::LightField;
  render::Quantity quantity = render::Quantity::View;
  std::string truth;  ///< Light field of a result or of labels; empty = the one its file names.
  io::MapReading reading{};       ///< Of a result, beyond what its file states.
  std::string minus;              ///< For a difference: the result that is subtracted.
  std::optional<ViewIndex> view;  ///< The center, or the middle of those there are.
  int label = 1;                  ///< Whose probability.
  double bad_threshold_px = kBadPixelThreshold_px;  ///< Of bad pixels.
  bool needs_light_field = false;
};

/// The map, with its scene if one was needed and is known.
struct LoadedMap {
  std::optional<Scene> scene;
  MapSource source;
  Interval disparity_range{};  ///< Of the colors of a disparity.
};

/// Reads what the map is made from; judges where it is an error. Throws UsageError if the subject
/// has no such quantity, InvalidInput if it lacks it in that view, IoError, Cancelled.
[[nodiscard]] LoadedMap load_map(const ShownMap& shown, const ReadOptions& read, Job& job);

}  // namespace episcope::cli
