// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"

#include <string>
#include <vector>

namespace episcope::io {

/// Looks for views that do not fit their neighbors: the same picture stored more than once, every
/// second row or column the other way round, two views in each other's place. Says so, a sentence
/// each. Views are compared in their middle of 512×512 px, reduced to at most 160 px: of two orders
/// the right one makes neighbors clearly less unlike. Says nothing of equal views where most are
/// equal, nor of views without texture. Linear in the views. Throws Cancelled.
[[nodiscard]] std::vector<std::string> find_misplaced_views(const LightField::Samples& samples,
                                                            const Progress& progress);

}  // namespace episcope::io
