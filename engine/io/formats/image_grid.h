// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/load_views.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope::io {

/// Reader of folders with equally sized images on a grid of views, or with such a folder inside
/// (`views_folder`).
[[nodiscard]] Reader image_grid_reader();

/// Facts about an image grid from files beside it.
struct ImageGridExtras {
  std::string reader = "image_grid";
  std::string format;            ///< For the report; empty = "image grid (pattern)".
  std::filesystem::path source;  ///< What was opened; empty = the folder of images.
  CameraGrid camera;
  std::optional<Interval> disparity_range;
  /// Reads the disparity of the views as stored, and may correct the camera. Empty = no truth.
  std::function<DisparityField(const LightField::Samples&, CameraGrid& camera, ConventionReport&)>
      read_truth;
  /// Files beside the views that are read, with their use ("depth of the center view").
  std::vector<std::pair<std::filesystem::path, std::string>> files{};
};

/// Reads a folder of equally sized images, for readers of folders that hold one. Throws IoError,
/// Undecided if nothing tells rows and columns, InvalidInput for a bad pattern, Cancelled.
[[nodiscard]] Scene read_image_grid(const std::filesystem::path& folder, const OpenOptions& options,
                                    const Progress& progress, const ImageGridExtras& extras = {});

/// Returns the grid, and size and sample type from the header of the center view. If the first or
/// the last view has another size or cannot be decoded, predicts from headers what
/// `load_usable_views` will open. Throws IoError.
[[nodiscard]] SceneProbe probe_views(const ViewFiles& views);

/// Probes a folder of images by names, headers and names of maps beside them. Throws IoError,
/// InvalidInput as reading does.
[[nodiscard]] SceneProbe probe_image_grid(const std::filesystem::path& folder,
                                          const OpenOptions& options);

/// Excerpts of the 2013 archive: a folder `lf` of views with depth.bin, attributes.dat and maybe
/// mask.png beside it.
[[nodiscard]] Reader excerpt_reader();

/// Camera attributes of an excerpt of the 2013 archive, by name: `dH` (baseline), `focalLength`
/// (px), `shift`, `min_disp`, `max_disp`.
using ExcerptAttributes = std::map<std::string, double>;

/// Reads lines "value //name" of an `attributes.dat`; others are skipped. Throws IoError if the
/// file cannot be read.
[[nodiscard]] ExcerptAttributes read_excerpt_attributes(const std::filesystem::path& path);

}  // namespace episcope::io
