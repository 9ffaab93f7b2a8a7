// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/image.h"
#include "engine/core/progress.h"
#include "engine/core/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace episcope::capture {

/// A picture that the camera's software made of a raw one.
struct ProcessedPicture {
  std::optional<double> lambda;       ///< Where it is in focus, if it is one of a stack.
  std::vector<std::uint8_t> encoded;  ///< A whole JPEG or PNG.
};

/// A map that came with them: "depthMap", in λ as the pictures, "confidenceMap", "depthLut".
struct ProcessedMap {
  std::string name;
  Image<float> values;
};

/// A container of a Lytro camera (-stk.lfp, -dm.lfp) without what the sensor saw.
struct ProcessedContainer {
  std::filesystem::path path;
  std::vector<ProcessedPicture> pictures;  ///< Ordered by λ; those without come last.
  std::vector<ProcessedMap> maps;          ///< The depth map first.
  std::optional<double> shown_lambda;      ///< Where the camera's software would focus first.

  /// "5 pictures in focus at λ -4.5 … 11, depthMap of 330×330 px from -20 to 11"
  [[nodiscard]] std::string text() const;
};

/// Nothing for a container with a raw picture. Throws IoError, also if there is no picture and no
/// map.
[[nodiscard]] std::optional<ProcessedContainer> read_processed(const std::filesystem::path& path);

/// A single view: the picture in focus at `shown_lambda`, else the first map, as gray from its
/// least to its greatest value. A note tells what the container holds. Throws IoError.
[[nodiscard]] Scene scene_of(const ProcessedContainer& container);

/// Writes pictures as they are and maps as PFM into a new folder; returns the files. Throws
/// IoError, Cancelled.
std::vector<std::string> write_processed(const std::filesystem::path& folder,
                                         const ProcessedContainer& container,
                                         const Progress& progress);

}  // namespace episcope::capture
