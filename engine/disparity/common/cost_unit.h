// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/volume.h"
#include "engine/core/light_field/light_field.h"
#include "engine/core/parallel/progress.h"
#include "engine/cuda/device/device_volume.h"

namespace episcope {

/// The unit in which smoothness is weighed against matching costs: the mean, over the valid pixels
/// of a view, of the mean cost of the labels within 0.5 px of a pixel's best one, at least its two
/// neighbours. It says how much it costs to be off, in the unit of the costs. Labels farther away
/// do not count: the mean over all labels grows with the range that is searched, though nothing
/// supports the labels added.
///
/// `costs` is `[y][label][x]` of the whole view, labels `step` px apart. Throws Cancelled.
[[nodiscard]] double cost_unit(const LightField& light_field, ViewIndex view,
                               VolumeView<const float> costs, double step,
                               const Progress& progress);

/// The same of costs on the device. Throws DeviceFailure, Cancelled.
[[nodiscard]] double cost_unit(const LightField& light_field, ViewIndex view,
                               const cuda::DeviceVolume& costs, double step,
                               const Progress& progress);

}  // namespace episcope
