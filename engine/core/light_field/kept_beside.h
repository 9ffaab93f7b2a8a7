// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>

namespace episcope {

/// One thing that is made of an object when it is asked for first, and kept for as long as the
/// object is. Thread-safe. Not copyable.
class KeptBeside {
 public:
  /// What is kept, else what `make()` returns, a pair of the thing and the bytes it takes; others
  /// wait meanwhile. What it throws is thrown, and nothing kept. All callers ask for the same T.
  template <class T, class Make>
  [[nodiscard]] std::shared_ptr<const T> get(const Make& make) {
    const std::lock_guard lock(lock_);
    if (!thing_.has_value()) {
      std::pair<T, std::size_t> made = make();
      thing_ = std::make_shared<const T>(std::move(made.first));
      bytes_ = made.second;
    }
    return std::any_cast<const std::shared_ptr<const T>&>(thing_);
  }

  /// Of what is kept.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::mutex lock_;
  std::any thing_;
  std::atomic<std::size_t> bytes_{0};
};

}  // namespace episcope
