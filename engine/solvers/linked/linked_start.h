// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/solvers/linked/link_sources.h"
#include "engine/solvers/linked/linked_unknowns.h"

namespace episcope {

/// Initialises u and the duals of pairs with the solutions of the images alone, to a gap of 1 %
/// or that of the options if that is wider. Images that are linked one to the next are solved in
/// this order, each beginning where the last one ended. Without smoothness u chooses the cheapest
/// labels. Throws Cancelled.
void start_from_single_images(const LinkedProblem& problem, const LinkSources& sources,
                              const LinkedOptions& options, const Progress& progress,
                              LinkedUnknowns& unknowns);

/// Row y of the costs of an image, `[label][x]`.
void look_up_costs(const LinkedProblem& problem, const LinkedKernel& kernel, int image, int y,
                   float* cost);

}  // namespace episcope
