// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// All views in one image: lenslets side by side (ESLF of Lytro cameras, MacPI), or views side by
/// side.
[[nodiscard]] Reader mosaic_reader();

}  // namespace episcope::io
