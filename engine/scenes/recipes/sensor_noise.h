// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope::scenes {

/// A normally distributed number of variance 1 that depends on `seed` and `counter` alone: the sum
/// of twelve uniform numbers minus six, so that no function of the maths library is involved.
[[nodiscard]] float sensor_noise(unsigned seed, std::uint64_t counter);

}  // namespace episcope::scenes
