// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::bench {

/// Uses the window for so long, with a method running at all times, and prints how late events were
/// handled: two light fields of 9×9×512×512, an input every 20 ms.
void measure_use(double seconds);

/// Opens small light fields, estimates, paints, compares and closes, so many times; prints memory,
/// descriptors and threads as it goes on.
void measure_soak(int rounds);

/// Opens a large light field: when the first picture and the EPIs are there, and what memory that
/// takes; then estimates with EPI_L on all views.
void measure_large(const char* file);

/// What the window costs while nobody does anything.
void measure_idle(double seconds);

}  // namespace episcope::bench
