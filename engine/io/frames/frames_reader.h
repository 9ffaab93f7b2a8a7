// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/reader.h"

namespace episcope::io {

/// A light field whose views are the pages of a TIFF file or the pictures of a film, row by row, in
/// another order that the views themselves tell, or along a line. A film is read where it is named
/// itself, not by the folder that it is in, since films are also made of light fields.
[[nodiscard]] Reader frames_reader();

}  // namespace episcope::io
