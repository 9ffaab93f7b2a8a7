// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::cli {

/// Exit codes that scripts rely on.
inline constexpr int kSuccess = 0;
inline constexpr int kFailed = 1;
inline constexpr int kWrongUsage = 2;
inline constexpr int kCancelled = 130;

}  // namespace episcope::cli
