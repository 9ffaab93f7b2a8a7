// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace episcope {

/// Asks the scheduler for short turns, soon after the calling thread, or one that it starts, has
/// something to do: for threads that the user waits for and that do little at once. Linux 6.12 and
/// later do so; before, such a thread may wait until the turns of others end.
void ask_for_short_turns();

/// Gives the calling thread, and those that it starts, a nice value and turns of this length; 0 =
/// those of the system. On Linux both belong to a thread. Does nothing where that is not possible.
void set_turns(int nice, std::uint64_t turn_ns);

}  // namespace episcope
