// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"
#include "engine/core/light_field/scene.h"

namespace episcope::io {

/// Brings float samples into the range that the engine works in and tells `report`. If one in a
/// hundred is clearly negative, they are brought from -1 … 1, or if they exceed that from their
/// quantiles of 0.1 and 99.9 %, to 0 … 1, unless the negative ones are noise around black: not far
/// below 0, and single ones. None beyond 1.5: as they are. Others are samples of 8,
/// 10, 12 or 16 bits (`full_scale`) if most are whole numbers, or, if half of them exceed 2 % of
/// that range as after resampling, of 8 bits, beyond 255.5 of 16: they are divided by it. Else they
/// are linear with highlights (HDR): divided by their quantile of 99.9
/// %, if that exceeds 1.5, so that only highlights exceed 1. Zeros do not count, and up to a
/// million are looked at. Integers stay as they are.
void scale_float_samples(LightField::Samples& samples, ConventionReport& report);

/// Turns samples that are NaN or infinite into 0 and tells `report` how many. To be called after
/// the order of views was checked, which bridges such samples.
void zero_nonfinite_samples(LightField::Samples& samples, ConventionReport& report);

}  // namespace episcope::io
