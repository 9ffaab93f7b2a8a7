// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::compare_section {

// Sections of the menu Compare, in their order.
inline constexpr int kMaps = 0;
inline constexpr int kChoice = 1;
inline constexpr int kRange = 2;
inline constexpr int kModes = 3;

}  // namespace episcope::compare_section
