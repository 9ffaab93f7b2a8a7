// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/thread_priority.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace episcope {
namespace {

constexpr int kNice = 10;

}  // namespace

void lower_thread_priority() {
  // On Linux the nice value belongs to the thread, and new threads inherit it.
  setpriority(PRIO_PROCESS, static_cast<id_t>(syscall(SYS_gettid)), kNice);
}

}  // namespace episcope
