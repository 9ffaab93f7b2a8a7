// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field/label_info.h"

#include <QIcon>
#include <QPalette>

namespace episcope {

/// Size of a swatch, logical pixels.
inline constexpr int kSwatchSize = 16;

/// The colour of a label as an icon; the same where its row is selected.
[[nodiscard]] QIcon swatch(const Rgb& rgb, const QPalette& palette);

}  // namespace episcope
