// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <type_traits>

namespace episcope {

/// What memory for hundreds of megabytes is made of.
enum class LargeKind : std::uint8_t {
  Heap,     ///< Ordinary memory.
  Zeros,    ///< Ordinary memory, taken as it is written.
  Scratch,  ///< A file without a name, for what exceeds the budget (memory_budget.h).
  File      ///< A part of a file, never written to.
};

/// A piece of it.
struct LargeMemory {
  void* data = nullptr;
  std::size_t bytes = 0;
  LargeKind kind = LargeKind::Heap;
};

/// Memory for hundreds of megabytes that are traversed with large strides: on Linux backed by huge
/// pages where the system grants them, which saves page faults and address-translation misses.
/// Uninitialised. What exceeds the budget is on disk (mapped_memory.h). Throws std::bad_alloc,
/// IoError if there is no room on the disk, either.
[[nodiscard]] LargeMemory allocate_large(std::size_t bytes);
/// The same, all 0; what is not written takes next to no memory.
[[nodiscard]] LargeMemory allocate_large_zeros(std::size_t bytes);
/// A part of a file (map_file).
[[nodiscard]] LargeMemory large_part_of_file(const std::filesystem::path& path,
                                             std::uintmax_t offset, std::size_t bytes);
void release_large(const LargeMemory& memory) noexcept;

/// Asks the system for the pages of such memory now instead of one by one when they are written first;
/// what they hold stays. A hint, for one piece of a large array on each thread.
void take_pages(void* memory, std::size_t bytes) noexcept;

/// Deleter of `make_large`.
struct LargeRelease {
  std::size_t bytes = 0;
  LargeKind kind = LargeKind::Heap;
  void operator()(void* memory) const noexcept { release_large({memory, bytes, kind}); }
};

/// An array of trivial elements in such memory.
template <class T>
using LargeArray = std::unique_ptr<T[], LargeRelease>;

template <class T>
[[nodiscard]] LargeArray<T> large_array(const LargeMemory& memory) {
  static_assert(std::is_trivially_destructible_v<T> &&
                std::is_trivially_default_constructible_v<T>);
  return LargeArray<T>(static_cast<T*>(memory.data), LargeRelease{memory.bytes, memory.kind});
}

/// Uninitialised.
template <class T>
[[nodiscard]] LargeArray<T> make_large(std::size_t count) {
  return large_array<T>(allocate_large(count * sizeof(T)));
}

}  // namespace episcope
