// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>

namespace episcope {

/// Memory for hundreds of megabytes that are traversed with large strides: on Linux backed by huge
/// pages where the system grants them, which saves page faults and address-translation misses.
/// Uninitialised. Throws std::bad_alloc.
[[nodiscard]] void* allocate_large(std::size_t bytes);
void release_large(void* memory) noexcept;

/// Deleter of `make_large`.
struct LargeRelease {
  void operator()(void* memory) const noexcept { release_large(memory); }
};

/// An array of trivial elements in such memory, uninitialised.
template <class T>
using LargeArray = std::unique_ptr<T[], LargeRelease>;

template <class T>
[[nodiscard]] LargeArray<T> make_large(std::size_t count) {
  static_assert(std::is_trivially_destructible_v<T> &&
                std::is_trivially_default_constructible_v<T>);
  return LargeArray<T>(static_cast<T*>(allocate_large(count * sizeof(T))));
}

}  // namespace episcope
