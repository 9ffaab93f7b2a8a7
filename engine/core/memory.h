// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <type_traits>

namespace episcope {

/// Kind of memory that a large array lies in.
enum class LargeKind : std::uint8_t {
  Heap,     ///< Ordinary memory.
  Zeros,    ///< Ordinary memory, taken as it is written.
  Scratch,  ///< A file without a name, for what exceeds the budget.
  File      ///< A part of a file, never written to.
};

/// A piece of memory for a large array.
struct LargeMemory {
  void* data = nullptr;
  std::size_t bytes = 0;
  LargeKind kind = LargeKind::Heap;
};

/// Memory for hundreds of megabytes that are traversed with large strides: on Linux backed by huge
/// pages where the system grants them, which saves page faults and address-translation misses.
/// Uninitialized. What exceeds `memory_budget` is on disk. Throws std::bad_alloc, and IoError if
/// the disk has no room either.
[[nodiscard]] LargeMemory allocate_large(std::size_t bytes);
/// As `allocate_large`, all 0; pages that are never written take next to no memory.
[[nodiscard]] LargeMemory allocate_large_zeros(std::size_t bytes);
/// A part of a file (map_file).
[[nodiscard]] LargeMemory large_part_of_file(const std::filesystem::path& path,
                                             std::uintmax_t offset, std::size_t bytes);
void release_large(const LargeMemory& memory) noexcept;

/// Prefaults the pages of such memory; contents are preserved. A hint, for one piece of a large
/// array on each thread.
void take_pages(void* memory, std::size_t bytes) noexcept;

/// Deleter of `make_large`.
struct LargeRelease {
  std::size_t bytes = 0;
  LargeKind kind = LargeKind::Heap;
  void operator()(void* memory) const noexcept { release_large({memory, bytes, kind}); }
};

/// An array of trivial elements in memory of `allocate_large`.
template <class T>
using LargeArray = std::unique_ptr<T[], LargeRelease>;

template <class T>
[[nodiscard]] LargeArray<T> large_array(const LargeMemory& memory) {
  static_assert(std::is_trivially_destructible_v<T> &&
                std::is_trivially_default_constructible_v<T>);
  return LargeArray<T>(static_cast<T*>(memory.data), LargeRelease{memory.bytes, memory.kind});
}

/// Uninitialized.
template <class T>
[[nodiscard]] LargeArray<T> make_large(std::size_t count) {
  return large_array<T>(allocate_large(count * sizeof(T)));
}

// The memory budget: how much memory light fields and other large arrays may take before they go to
// disk. The whole process has one budget. It is set when a program starts, and changes no result.

/// Bytes that could be taken now without driving out other programs: what the system calls
/// available, or what the control group of the process leaves, whichever is less.
[[nodiscard]] std::size_t free_memory();

/// Bytes of memory that this process has in use, with what it shares with others.
[[nodiscard]] std::size_t used_memory();

/// From now on arrays of a megabyte and more go back to the system as soon as they are freed.
/// Otherwise the allocator keeps what it has grown used to: twice what a run in blocks needs.
void return_freed_memory();

/// The budget in bytes: as set, else two thirds of what is free now.
[[nodiscard]] std::size_t memory_budget();

/// Sets the budget; nothing = two thirds of what is free, whenever it is asked for.
void set_memory_budget(std::optional<std::size_t> bytes);
[[nodiscard]] bool is_memory_budget_set();

/// Whether samples of so many bytes are better mapped from their file than read: beyond a third of
/// what may be taken (of the budget if one is set, else of what is free). Smaller ones are read, so
/// that nothing that happens to their file matters any more.
[[nodiscard]] bool is_better_mapped(double bytes);

/// Folder on a disk for arrays that do not fit, made when it is first needed. By default the folder
/// of temporary files.
void set_scratch_folder(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path scratch_folder();

/// Reserves memory of the budget during its lifetime for allocations that do not go through
/// `allocate_large`: large arrays get only the rest.
class MemorySetAside {
 public:
  explicit MemorySetAside(std::size_t bytes) noexcept;
  ~MemorySetAside();
  MemorySetAside(const MemorySetAside&) = delete;
  MemorySetAside& operator=(const MemorySetAside&) = delete;

 private:
  std::size_t bytes_;
};

// Mapped memory: its contents are in a file. The system reads them on access and drops them when
// memory is short. Bytes behind the last one can be read up to the next page, and one page more.

/// `bytes` of a file from `offset` on. Writing there changes the memory, never the file, and takes
/// ordinary memory. Throws IoError if the file is shorter or cannot be mapped.
///
/// If a file is truncated while it is mapped, the lost bytes read as 0 and `has_lost_pages` is true
/// from then on.
[[nodiscard]] void* map_file(const std::filesystem::path& path, std::uintmax_t offset,
                             std::size_t bytes);

/// `bytes`, all 0, in a file without a name in `scratch_folder()`, which the system removes with
/// its last user, whatever ends it. Throws IoError if the disk has no room for it.
[[nodiscard]] void* map_scratch(std::size_t bytes);

/// `bytes`, all 0, that take no memory until they are looked at. Throws std::bad_alloc.
[[nodiscard]] void* map_zeros(std::size_t bytes);

void unmap(void* memory, std::size_t bytes) noexcept;

/// Drops what the process holds of such memory of `map_file` that was never written, or of
/// `map_scratch`; it is read again when it is looked at.
void forget_pages(const void* memory, std::size_t bytes) noexcept;

/// Has the system begin to read it, without waiting.
void fetch_pages(const void* memory, std::size_t bytes) noexcept;

/// Whether any file that is or was mapped has lost what was mapped of it.
[[nodiscard]] bool has_lost_pages();

}  // namespace episcope
