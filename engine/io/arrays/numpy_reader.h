// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// `.npy` and `.npz` files that hold a light field of any order of axes.
[[nodiscard]] Reader numpy_reader();

}  // namespace episcope::io
