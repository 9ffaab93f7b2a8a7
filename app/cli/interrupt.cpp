// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/interrupt.h"

#include <pthread.h>
#include <csignal>
#include <thread>

namespace episcope::cli {
namespace {

// Ends the waiting thread; nobody else sends it.
constexpr int kEndOfWaiting = SIGUSR2;

/// Signals to wait for. One that the caller had ignored (nohup, a job in the background) stays so.
sigset_t awaited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, kEndOfWaiting);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction action {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler != SIG_IGN) sigaddset(&signals, signal);
  }
  return signals;
}

void wait_for_signals(sigset_t signals, const std::stop_source& stop) {
  int signal = 0;
  while (sigwait(&signals, &signal) == 0 && signal != kEndOfWaiting) stop.request_stop();
}

}  // namespace

struct Interrupt::Waiter {
  std::thread thread;
};

Interrupt::Interrupt() : waiter_(std::make_unique<Waiter>()) {
  const sigset_t signals = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_->thread = std::thread(wait_for_signals, signals, stop_);
}

Interrupt::~Interrupt() {
  pthread_kill(waiter_->thread.native_handle(), kEndOfWaiting);
  waiter_->thread.join();
}

}  // namespace episcope::cli
