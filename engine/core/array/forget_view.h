// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/array/mapped_memory.h"
#include "engine/core/array/view_stack.h"

namespace episcope {

/// Of a view on disk, drops what the process holds in memory; changes nothing else.
template <class T>
void forget_view(const ViewStack<T>& stack, ViewIndex view) noexcept {
  if (stack.is_on_disk()) forget_pages(stack.view(view).data, sizeof(T) * stack.view_size());
}

}  // namespace episcope
