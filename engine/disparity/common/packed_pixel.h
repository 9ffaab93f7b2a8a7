// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// How a pixel is packed (packed_views.h): constants alone, so that kernels may include them.
inline constexpr int kPackedBits = 10;                      ///< Of one channel.
inline constexpr int kPackedMost = (1 << kPackedBits) - 1;  ///< Its largest value; also its mask.
inline constexpr int kPackedInvalidBit = 3 * kPackedBits;   ///< Set in pixels that are not valid.

}  // namespace episcope
