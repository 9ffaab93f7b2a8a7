// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Lets the scheduler prefer other threads to the calling one and to those that it starts, so that
/// the window stays fluent while a job takes every core. Does nothing where that is not possible.
void lower_thread_priority();

}  // namespace episcope
