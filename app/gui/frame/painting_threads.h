// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace episcope {

/// Starts the threads among which Qt divides the drawing of pictures, and keeps them. Qt would make
/// them when they are needed and end them after a while; made by a lowered thread that happens to
/// draw (lower_thread_priority), they would stay behind every job, and the window waits for them.
void keep_painting_threads();

}  // namespace episcope
