// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace episcope {

/// Sets memory of the budget (memory_budget.h) aside, for as long as it lives, for what is about to
/// be taken otherwise than by large_memory.h: large arrays get only the rest.
class MemorySetAside {
 public:
  explicit MemorySetAside(std::size_t bytes) noexcept;
  ~MemorySetAside();
  MemorySetAside(const MemorySetAside&) = delete;
  MemorySetAside& operator=(const MemorySetAside&) = delete;

 private:
  std::size_t bytes_;
};

}  // namespace episcope
