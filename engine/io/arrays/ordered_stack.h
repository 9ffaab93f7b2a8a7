// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/view_stack.h"

namespace episcope::io {

/// A stack whose samples lie in memory in the order of views: the given one, which must outlive
/// this, or a copy.
template <class T>
class OrderedStack {
 public:
  explicit OrderedStack(const ViewStack<T>& stack)
      : given_(stack), copy_(stack.is_in_order() ? ViewStack<T>() : stack.clone()) {}
  [[nodiscard]] const ViewStack<T>& get() const { return copy_.empty() ? given_ : copy_; }

 private:
  const ViewStack<T>& given_;
  ViewStack<T> copy_;
};

}  // namespace episcope::io
