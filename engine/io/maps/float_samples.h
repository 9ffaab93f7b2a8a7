// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

namespace episcope::io {

/// Brings float samples into the range that the engine works in and tells `report`. None
/// beyond 1.5: as they are. Others are samples of 8 bits, or beyond 255.5 of 16 bits, if most are
/// whole numbers or, as after resampling, half of them exceed 2 % of that range: they are divided
/// by 255 or 65535. Else they are linear with highlights (HDR): divided by their quantile of 99.9
/// %, if that exceeds 1.5, so that only highlights exceed 1. Zeros do not count, and up to a
/// million are looked at. Integers stay as they are.
void scale_float_samples(LightField::Samples& samples, ConventionReport& report);

/// Turns samples that are NaN or infinite into 0 and tells `report` how many. To be called after
/// the order of views was checked, which bridges such samples.
void zero_nonfinite_samples(LightField::Samples& samples, ConventionReport& report);

}  // namespace episcope::io
