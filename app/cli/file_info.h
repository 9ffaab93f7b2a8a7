// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/output.h"
#include "engine/core/camera_grid.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace episcope::cli {

/// What `info` tells of a file.
struct FileInfo {
  std::vector<std::pair<std::string, std::string>> lines;  ///< Label and text, in order.
  Json json;
};

/// Whether options of reading are given, which make views of arrays and pictures.
enum class Reads { AsItIs, AsViews };

/// Describes a result, labels, a project of the window, a camera or a pose. Nothing for what else
/// there is, such as light fields. Throws IoError for a damaged file.
[[nodiscard]] std::optional<FileInfo> describe_file(const std::string& input, Reads reads);

/// Adds `camera`, if it is known.
void add_camera(const CameraGrid& camera, Json& json);
/// "baseline 1, focal length 2, shift 0 px", or that it is not known.
[[nodiscard]] std::string camera_text(const CameraGrid& camera);

/// "-1.5 … 2.25 px".
[[nodiscard]] std::string range_text(const Interval& range);

}  // namespace episcope::cli
