// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"

namespace episcope {

class MethodRuns;
struct RunRequest;

/// Asks for methods and open scenes and runs all of them. `form` holds the parameters of the method
/// that the form shows, which is proposed; the others run with their defaults.
void ask_for_batch(const Workbench& bench, MethodRuns& runs, const RunRequest& form);

}  // namespace episcope
