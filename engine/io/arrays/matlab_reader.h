// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// MATLAB files that hold a light field LF(t, s, v, u, c), as LFToolbox writes: version 7.3, which
/// is HDF5, and 5 to 7.
[[nodiscard]] Reader matlab_reader();

}  // namespace episcope::io
