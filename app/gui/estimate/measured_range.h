// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "engine/core/parameter/parameter.h"

namespace episcope {

class MethodPanel;

/// `range` with one end moved to a disparity. The other end stays; where it is not known or would
/// not lie beyond, it is 0.5 px away. Rounded to 0.01 px, so that what is measured stays inside.
enum class RangeEnd { Lower, Upper };
[[nodiscard]] Interval with_end(Interval range, RangeEnd end, double disparity_px);

/// Commands that make the chosen measurement an end of the range in the form of a method.
void add_measured_range(const Workbench& bench, MethodPanel* panel);

}  // namespace episcope
