// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope::bench {

class TimedApplication;

/// Uses the window for so long, with a method running at all times or (`runs_methods` false) with
/// results that were there before, and prints how late events were handled and which of them took
/// long: two light fields of 9×9×512×512 with so many strokes on each, of three labels, that are
/// segmented live; an input every 20 ms. What is late without methods is the window's own work or
/// that of other programs.
void measure_use(TimedApplication& application, double seconds, int strokes, bool runs_methods);

/// Opens small light fields, estimates, paints, compares and closes, so many times; prints memory,
/// descriptors and threads as it goes on.
void measure_soak(int rounds);

/// Opens a large light field: when the first picture and the EPIs are there, and what memory that
/// takes; then estimates with EPI_L on all views.
void measure_large(const char* file);

/// What the window costs while nobody does anything.
void measure_idle(double seconds);

}  // namespace episcope::bench
