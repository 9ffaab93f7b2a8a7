// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// Excerpts of the 2013 archive: a folder `lf` of views with depth.bin, attributes.dat and maybe
/// mask.png beside it.
[[nodiscard]] Reader excerpt_reader();

}  // namespace episcope::io
