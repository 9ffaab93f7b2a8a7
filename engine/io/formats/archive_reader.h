// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/models/reader.h"

namespace episcope::io {

inline constexpr const char* kArchiveReader = "archive";

/// Light fields of the 2013 archive: lf.h5, with labels.h5 and the companions beside it.
[[nodiscard]] Reader archive_reader();

}  // namespace episcope::io
