// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/durable/background_flush.h"

#include "engine/io/durable/atomic_file.h"

#include <unistd.h>
#include <cerrno>
#include <utility>

namespace episcope::io {

BackgroundFlush::BackgroundFlush(int descriptor, std::filesystem::path path, Start start)
    : descriptor_(descriptor),
      path_(std::move(path)),
      written_(start == Start::Unflushed ? 1 : 0),
      is_named_(start == Start::Flushed),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

BackgroundFlush::~BackgroundFlush() {
  thread_.request_stop();
  thread_.join();
}

void BackgroundFlush::request() {
  const std::scoped_lock lock(mutex_);
  ++written_;
  changed_.notify_all();
}

void BackgroundFlush::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return flushed_ == written_ || error_ != 0; });
}

int BackgroundFlush::error() const {
  const std::scoped_lock lock(mutex_);
  return error_;
}

void BackgroundFlush::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, stop, [this] { return flushed_ != written_; });
    if (flushed_ == written_) return;
    const std::uint64_t reached = written_;
    lock.unlock();
    const int error = ::fdatasync(descriptor_) == 0 ? 0 : errno;
    if (!std::exchange(is_named_, true)) flush_folder(path_);
    lock.lock();
    flushed_ = reached;
    if (error != 0) error_ = error;
    changed_.notify_all();
  }
}

}  // namespace episcope::io
