// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/shell/jobs.h"

#include <future>
#include <memory>
#include <utility>

namespace episcope {

/// Keeps the later jobs of a lane waiting until it is released, also if all of them are cancelled.
class HeldLane {
 public:
  HeldLane(Jobs& jobs, Lane lane) {
    jobs.start<bool>(
        lane, "held",
        [is_over = over_->get_future().share()](const Progress&) {
          is_over.wait();
          return true;
        },
        [](bool) {});
  }
  ~HeldLane() { release(); }
  HeldLane(const HeldLane&) = delete;
  HeldLane& operator=(const HeldLane&) = delete;

  void release() {
    if (auto over = std::move(over_)) over->set_value();
  }

 private:
  std::unique_ptr<std::promise<void>> over_ = std::make_unique<std::promise<void>>();
};

}  // namespace episcope
