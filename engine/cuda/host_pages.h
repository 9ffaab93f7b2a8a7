// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/progress.h"
#include "engine/core/view_stack.h"

#include <cstddef>
#include <future>

namespace episcope::cuda {

/// Asks the system for the pages of memory (take_pages) on all threads, while the device computes
/// what will be copied there; what they hold stays. The memory must live until the future has been
/// waited for, which its destructor does.
[[nodiscard]] std::future<void> begin_pages(void* memory, std::size_t bytes,
                                            const Progress& progress);

/// Of a stack in memory.
template <class T>
[[nodiscard]] std::future<void> begin_pages(ViewStack<T>& stack, const Progress& progress) {
  if (stack.is_on_disk()) return {};
  return begin_pages(stack.data(), stack.size() * sizeof(T), progress);
}

}  // namespace episcope::cuda
