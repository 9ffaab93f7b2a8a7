// SPDX-License-Identifier: BSD-3-Clause
#include "app/benchmark/run/workload.h"

#include <algorithm>

namespace episcope {

void Workload::expect(double seconds) {
  ends_.push_back((ends_.empty() ? 0 : ends_.back()) + std::max(seconds, 1e-3));
}

Progress Workload::next(const std::string& title) {
  if (done_ >= ends_.size()) return progress_.part(1, 1).titled(title);
  const double begin = done_ == 0 ? 0 : ends_[done_ - 1];
  const double end = ends_[done_++];
  return progress_.part(begin / ends_.back(), end / ends_.back()).titled(title);
}

void Workload::skip(std::size_t count) {
  done_ = std::min(done_ + count, ends_.size());
  if (done_ > 0) progress_.report(ends_[done_ - 1] / ends_.back());
}

}  // namespace episcope
