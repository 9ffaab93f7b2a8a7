// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/grid/name_parts.h"

namespace episcope::io {

/// Separates row and column in names where their digits run together, as in view11.png …
/// view99.png: the only number that varies has an even count of digits everywhere, its halves run
/// over a full grid from 0 or 1 on, and as one number it would have gaps. Other groups stay as they
/// are.
void separate_joined_digits(NameGroup& group);

}  // namespace episcope::io
