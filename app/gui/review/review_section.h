// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Section of the menu Segmentation, after those of the segmentation itself.
inline constexpr int kCheckSection = 2;

}  // namespace episcope
