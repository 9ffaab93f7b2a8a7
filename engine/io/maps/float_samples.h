// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

namespace episcope::io {

/// Brings float samples into the range that the engine works in and tells `report`: those beyond
/// 1.5 are taken for samples of 8 bits and divided by 255, beyond 255.5 for those of 16 bits and
/// divided by 65535. Integers stay as they are.
void scale_float_samples(LightField::Samples& samples, ConventionReport& report);

/// Turns samples that are NaN or infinite into 0 and tells `report` how many. To be called after
/// the order of views was checked, which bridges such samples.
void zero_nonfinite_samples(LightField::Samples& samples, ConventionReport& report);

}  // namespace episcope::io
