// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/collection/collection_entry.h"

#include <vector>

namespace episcope::io {

/// Gives each result to the light field among `entries` that it names as its source; else to the
/// only one of its folder; else to the only one whose name its own begins with. Others are left
/// out.
void add_results(std::vector<CollectionEntry>& entries, const std::vector<ResultBeside>& results);

}  // namespace episcope::io
