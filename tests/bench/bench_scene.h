// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/light_field.h"

#include <cstddef>

namespace episcope::bench {

/// The demo scene at 9×9 views of 768×768 RGB, rendered once for all benchmarks of the program.
/// Only its samples are kept.
[[nodiscard]] const LightField& demo_768();

/// Bytes per second, read and written counted, that all threads together copy: best of several.
[[nodiscard]] double copied_bytes_per_second();

/// Starts anew to record the largest memory of this process; returns false where the system does
/// not offer it.
bool reset_peak_memory();
/// Largest resident memory of this process since then, bytes; 0 where the system does not tell.
[[nodiscard]] std::size_t peak_memory();

/// Seconds of a steady clock.
[[nodiscard]] double now();

}  // namespace episcope::bench
