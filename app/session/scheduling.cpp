// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/scheduling.h"

#include <linux/sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <cstdint>

namespace episcope {
namespace {

constexpr int kNice = 10;
// The shortest that can be asked for.
constexpr std::uint64_t kShortTurn_ns = 100'000;

// As in linux/sched/types.h, which in Debian 12 cannot be included beside the C library's sched.h.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = SCHED_NORMAL;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = 0;
  std::uint64_t deadline = 0;
  std::uint64_t period = 0;
};

/// Gives the calling thread, and those that it starts, a nice value and turns of this length; 0 =
/// the length of the system. On Linux both belong to a thread.
void set_turns(int nice, std::uint64_t turn_ns) {
  SchedulingAttributes attributes;
  attributes.nice = nice;
  attributes.runtime = turn_ns;
  if (syscall(SYS_sched_setattr, 0, &attributes, 0U) != 0) setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace

void lower_thread_priority() {
  set_turns(kNice, 0);
}

void request_low_latency() {
  set_turns(getpriority(PRIO_PROCESS, 0), kShortTurn_ns);
}

}  // namespace episcope
