// SPDX-License-Identifier: BSD-3-Clause
#include "app/session/run/thread_priority.h"

#include "app/session/run/turns.h"

namespace episcope {
namespace {

constexpr int kNice = 10;

}  // namespace

void lower_thread_priority() {
  set_turns(kNice, 0);
}

}  // namespace episcope
