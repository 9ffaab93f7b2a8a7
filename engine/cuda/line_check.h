// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/progress.h"
#include "engine/core/view_stack.h"
#include "engine/cuda/device_data.h"

namespace episcope::cuda {

/// What `check_lines` does; see LineCheck.
struct LineCheckSteps {
  bool chooses_sides = true;
  bool reduces_confidence = true;
};

/// Changes disparity and confidence of the views that both stacks cover, the center view among
/// them, as check_lines of the CPU. Throws DeviceFailure, Cancelled.
void check_lines(const LightField& light_field, const LineCheckSteps& steps,
                 ViewStack<float>& disparity, ViewStack<float>& confidence,
                 const Progress& progress);

/// Checks maps that are on the device.
void check_lines(const LightField& light_field, const LineCheckSteps& steps, DeviceMaps& maps,
                 const Progress& progress);

/// Replaces the disparity of rays that other views see through, as replace_occluded of the CPU;
/// both stacks cover all views. Throws DeviceFailure, Cancelled.
void replace_occluded(const LightField& light_field, ViewStack<float>& disparity,
                      const ViewStack<float>& confidence, const Progress& progress);

}  // namespace episcope::cuda
