// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr int kSlowdown = 15;
#else
inline constexpr int kSlowdown = 1;
#endif

/// How long a test waits, in ms, for what must come: nobody waits so long unless it is broken, on a
/// busy machine and under sanitizers either.
inline constexpr int kPatience = 30'000 * kSlowdown;
/// The same for a built-in scene of full size to be made, or for all its views to be labeled.
inline constexpr int kScenePatience = 120'000 * kSlowdown;

}  // namespace episcope
