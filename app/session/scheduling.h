// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Lets the scheduler prefer other threads to the calling one and to those that it starts, so that
/// the window stays fluent while a job takes every core. Does nothing where that is not possible.
void lower_thread_priority();

/// Asks the scheduler for short turns, soon after the calling thread, or one that it starts, has
/// something to do: for threads that the user waits for and that do little at once. Linux 6.12 and
/// later do so; before, such a thread may wait until the turns of others end.
void request_low_latency();

}  // namespace episcope
