// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/cli/output.h"

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

/// "-1.5 … 2.25 px".
[[nodiscard]] std::string range_text(const Interval& range);

}  // namespace episcope::cli
