// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/light_field.h"

#include <QStringList>

namespace episcope {

/// The samples of a pixel as they are stored, one text a channel.
[[nodiscard]] QStringList sample_texts(const LightField& light_field, ViewIndex view,
                                       PixelIndex pixel);

}  // namespace episcope
