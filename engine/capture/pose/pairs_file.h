// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/capture/pose/point_pair.h"

#include <filesystem>
#include <span>
#include <vector>

namespace episcope::capture {

/// Reads pairs as CSV, a line each: name,x_px,y_px,X,Y,Z, and behind them 1 if the pair is locked.
/// A first line that says so, empty lines and lines that begin with # are skipped. Throws IoError,
/// naming the line.
[[nodiscard]] std::vector<PointPair> read_pairs(const std::filesystem::path& path);

/// Writes such a file, so that the numbers are read back exactly; the column of locks only if there
/// are any. Atomic. Throws IoError, also for names with a comma or a line end.
void write_pairs(const std::filesystem::path& path, std::span<const PointPair> pairs);

}  // namespace episcope::capture
