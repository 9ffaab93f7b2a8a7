// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Sections of the menu Annotate, in their order.
namespace annotate_section {

inline constexpr int kMode = 0;
inline constexpr int kHistory = 1;
inline constexpr int kTools = 2;
inline constexpr int kCarry = 3;

}  // namespace annotate_section

/// Sections of its menu Label.
namespace label_section {

inline constexpr int kLabels = 0;
inline constexpr int kEdit = 1;
inline constexpr int kLook = 2;

}  // namespace label_section

}  // namespace episcope
