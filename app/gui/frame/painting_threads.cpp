// SPDX-License-Identifier: BSD-3-Clause
#include "app/gui/frame/painting_threads.h"

#include "app/session/run/turns.h"

#include <QThreadPool>

#include <algorithm>
#include <latch>
#include <memory>

namespace episcope {
namespace {

// A picture of a window has too few rows for more.
constexpr int kMostThreads = 4;

}  // namespace

void keep_painting_threads() {
  QThreadPool& pool = *QThreadPool::globalInstance();
  if (pool.expiryTimeout() < 0) return;
  const int count = std::min(pool.maxThreadCount(), kMostThreads);
  pool.setMaxThreadCount(count);
  pool.setExpiryTimeout(-1);
  // Each waits for the others, so that each gets a thread of its own.
  const auto all = std::make_shared<std::latch>(count);
  for (int i = 0; i < count; ++i) {
    pool.start([all] {
      ask_for_short_turns();
      all->arrive_and_wait();
    });
  }
}

}  // namespace episcope
