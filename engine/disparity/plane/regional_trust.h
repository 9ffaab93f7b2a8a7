// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/image.h"

namespace episcope {

/// The mean of a confidence over the 9×9 px around each pixel: single pixels say little of how far
/// noise leaves labels apart.
[[nodiscard]] Image<float> regional_trust(ImageView<const float> confidence);

}  // namespace episcope
