// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/progress.h"

#include "engine/core/error.h"

#include <algorithm>
#include <mutex>
#include <thread>

namespace episcope {

struct Progress::Shared {
  std::stop_token stop;
  std::stop_token finish;
  Listener listener;
  std::mutex mutex;
  ProgressState state;
};

Progress::Progress(int threads) : Progress(std::stop_token{}, nullptr, threads) {}

Progress::Progress(std::stop_token stop, Listener listener, int threads)
    : Progress(std::move(stop), {}, std::move(listener), threads) {}

Progress::Progress(std::stop_token stop, std::stop_token finish, Listener listener, int threads)
    : shared_(std::make_shared<Shared>()),
      threads_(threads > 0 ? threads
                           : std::max(1, static_cast<int>(std::thread::hardware_concurrency()))) {
  shared_->stop = std::move(stop);
  shared_->finish = std::move(finish);
  shared_->listener = std::move(listener);
}

void Progress::report(double fraction) const {
  if (!shared_->listener) return;
  constexpr double least_step = 1e-3;
  const double whole = begin_ + std::clamp(fraction, 0.0, 1.0) * (end_ - begin_);
  const std::scoped_lock lock(shared_->mutex);
  const bool is_end = whole >= 1 && shared_->state.fraction < 1;
  if (whole < shared_->state.fraction + least_step && !is_end) return;
  shared_->state.fraction = whole;
  shared_->listener(shared_->state);
}

void Progress::step(const std::string& text) const {
  if (!shared_->listener) return;
  const std::scoped_lock lock(shared_->mutex);
  shared_->state.step = title_ + text;
  shared_->listener(shared_->state);
}

void Progress::check() const {
  if (shared_->stop.stop_requested()) throw Cancelled{};
}

bool Progress::stop_requested() const {
  return shared_->stop.stop_requested();
}

bool Progress::finish_requested() const {
  return shared_->finish.stop_requested();
}

int Progress::threads() const {
  return threads_;
}

Progress Progress::part(double begin, double end) const {
  Progress inner = *this;
  inner.begin_ = begin_ + begin * (end_ - begin_);
  inner.end_ = begin_ + end * (end_ - begin_);
  return inner;
}

Progress Progress::limited_to(int threads) const {
  Progress limited = *this;
  if (threads > 0) limited.threads_ = std::min(threads, threads_);
  return limited;
}

Progress Progress::titled(const std::string& title) const {
  Progress named = *this;
  named.title_ = title_ + title + ": ";
  return named;
}

}  // namespace episcope
