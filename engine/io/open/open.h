// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace episcope::io {

/// Of which views maps of disparity and depth are read, where there are any of all.
enum class MapViews { All, Center };

/// Overrides of what a reader would find out by itself.
struct OpenOptions {
  enum class Flip { Auto, None, U, V, Both };
  Flip flip = Flip::Auto;  ///< Which view axes to reverse against the order stored.
  /// Whether dH of an archive file holds the factor xRes (eq. 2) or lacks it.
  enum class Units { Auto, WithWidth, WithoutWidth };
  Units units = Units::Auto;
  std::string pattern;  ///< Image grids: file name with {row} and {col} or {index}; empty = detect.
  bool snake = false;   ///< Image grids: every second row was captured right to left.
  double focus_px = 0;  ///< Focus plane to bake in after reading (shear.h), px per view step.
  /// Without, no truth nor labels are given: only the map of the centre view is then read, by which
  /// units and the order of views are settled.
  bool needs_truth = true;
  [[nodiscard]] MapViews map_views() const {
    return needs_truth ? MapViews::All : MapViews::Center;
  }
  /// Called on the reading thread as soon as the centre view is there, before the rest is read.
  std::function<void(const Image<std::uint8_t>& center_rgb, const LightFieldInfo&, GridShape)>
      on_center_view;
};

/// Opens whatever holds a light field: an `lf.h5`, a scene folder of the 2013 archive, a folder of
/// the 2016 benchmark, a folder of images on a grid. Converts to the house convention, looks for
/// truth, labels and companions beside it, and reports what it found and how it checked it.
/// Throws IoError with one sentence (what, where, what to do), Cancelled on a stop request.
[[nodiscard]] Scene open_scene(const std::filesystem::path& path, const OpenOptions& options,
                               const Progress& progress);

}  // namespace episcope::io
