// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/arrays/array_file.h"
#include "engine/io/open/open_options.h"

#include <memory>

namespace episcope::io {

/// The file as if a list of 3N grey pictures in C order, 3N×H×W, were one of N coloured ones,
/// N×3×H×W, if the pictures are the channels of views one after the other, as networks take them:
/// then views move, and channels do not. Null for other files, and where options say what is meant.
/// `file` must outlive it.
[[nodiscard]] std::unique_ptr<ArrayFile> with_stacked_channels(const ArrayFile& file,
                                                               const OpenOptions& options);

}  // namespace episcope::io
