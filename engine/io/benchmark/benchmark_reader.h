// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/scene.h"
#include "engine/core/parallel/progress.h"
#include "engine/io/open/open.h"

#include <filesystem>

namespace episcope::io {

/// Whether a folder looks like a scene of the 2016 benchmark.
[[nodiscard]] bool is_benchmark_folder(const std::filesystem::path& folder);

/// Reads a scene of the 4D Light Field Benchmark [HJKG16]. Throws IoError,
/// Cancelled.
[[nodiscard]] Scene read_benchmark(const std::filesystem::path& folder, const OpenOptions& options,
                                   const Progress& progress);

}  // namespace episcope::io
