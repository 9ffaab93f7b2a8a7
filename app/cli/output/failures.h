// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <cstddef>
#include <string>

namespace episcope::cli {

/// What failed of many light fields, of which the others go on.
class Failures {
 public:
  void add(const std::string& sentence) {
    if (count_++ == 0) first_ = sentence;
  }
  /// Throws Error, with the first sentence, if anything failed of `total`.
  void require_none(std::size_t total) const {
    if (count_ == 0) return;
    throw Error(std::to_string(count_) + " of " + std::to_string(total) +
                " light fields failed, the first: " + first_);
  }

 private:
  std::size_t count_ = 0;
  std::string first_;
};

}  // namespace episcope::cli
