// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/turns.h"

#include <linux/sched.h>
#include <linux/sched/types.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace episcope {
namespace {

// The shortest that can be asked for.
constexpr std::uint64_t kShortTurn_ns = 100'000;

}  // namespace

void ask_for_short_turns() {
  set_turns(getpriority(PRIO_PROCESS, 0), kShortTurn_ns);
}

void set_turns(int nice, std::uint64_t turn_ns) {
  sched_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.sched_policy = SCHED_NORMAL;
  attributes.sched_nice = nice;
  attributes.sched_runtime = turn_ns;
  if (syscall(SYS_sched_setattr, 0, &attributes, 0U) != 0) setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace episcope
