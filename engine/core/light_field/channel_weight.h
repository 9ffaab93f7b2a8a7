// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// How often a channel counts in a squared difference of colours, so that what is measured by it
/// means the same in gray as in colour: one channel counts as three equal ones.
[[nodiscard]] constexpr double channel_weight(int channels) {
  return channels == 1 ? 3 : 1;
}

}  // namespace episcope
