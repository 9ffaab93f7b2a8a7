// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"
#include "engine/core/scene.h"

namespace episcope::io {

/// Brings float samples into the range that the engine works in and tells `report`: samples that
/// are NaN or infinite become 0; samples beyond 1.5 are taken for those of 8 bits and divided by
/// 255, beyond 255.5 for those of 16 bits and divided by 65535. Integers stay as they are.
void tidy_float_samples(LightField::Samples& samples, ConventionReport& report);

}  // namespace episcope::io
