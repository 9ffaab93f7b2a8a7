// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

inline constexpr const char* kVersion = "0.1.0";

}  // namespace episcope
