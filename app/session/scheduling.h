// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Lowers the priority of the calling thread and of threads that it starts, so that the window
/// stays fluent while a job takes every core. Does nothing where that is not possible.
void lower_thread_priority();

/// Asks the scheduler for short time slices that begin soon, for the calling thread and threads
/// that it starts: for threads that the user waits for and that do little at once. Needs Linux
/// 6.12; earlier, such a thread may wait until the time slices of others end.
void request_low_latency();

}  // namespace episcope
