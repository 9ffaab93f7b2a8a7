// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/load_views.h"
#include "engine/io/models/reader.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope::io {

/// Folders of equally sized images on a grid of views, or with such a folder inside
/// (`views_folder`).
[[nodiscard]] Reader image_grid_reader();

/// What is known of an image grid from files beside it.
struct ImageGridExtras {
  std::string reader = "image_grid";
  std::string format;            ///< For the report; empty = "image grid (pattern)".
  std::filesystem::path source;  ///< What was opened; empty = the folder of images.
  CameraGrid camera;
  std::optional<Interval> disparity_range;
  /// Reads the disparity of the views as stored; may correct the camera. Empty = no truth.
  std::function<DisparityField(const LightField::Samples&, CameraGrid& camera, ConventionReport&)>
      read_truth;
  /// Files beside the views that are read, and as what ("depth of the centre view").
  std::vector<std::pair<std::filesystem::path, std::string>> files{};
};

/// Reads a folder of equally sized images, for readers of folders that hold one. Throws IoError,
/// Undecided if nothing tells rows and columns, InvalidInput for a bad pattern, Cancelled.
[[nodiscard]] Scene read_image_grid(const std::filesystem::path& folder, const OpenOptions& options,
                                    const Progress& progress, const ImageGridExtras& extras = {});

/// Grid, and size and samples by the header of the centre view. Where the first or the last view
/// has another size, or one cannot be decoded, what `load_usable_views` will open as far as headers
/// tell it. Throws IoError.
[[nodiscard]] SceneProbe probe_views(const ViewFiles& views);

/// What names and headers of a folder of images tell, and names of the maps beside them. Throws
/// IoError, InvalidInput as reading does.
[[nodiscard]] SceneProbe probe_image_grid(const std::filesystem::path& folder,
                                          const OpenOptions& options);

}  // namespace episcope::io
