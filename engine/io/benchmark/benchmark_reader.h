// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// Scenes of the 4D Light Field Benchmark of 2016 [HJKG16]: a folder of images with parameters.cfg,
/// PFM truth, object ids and region masks.
[[nodiscard]] Reader benchmark_reader();

}  // namespace episcope::io
