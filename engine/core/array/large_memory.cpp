// SPDX-License-Identifier: BSD-3-Clause
#include "engine/core/array/large_memory.h"

#include "engine/core/array/mapped_memory.h"
#include "engine/core/array/memory_budget.h"
#include "engine/core/array/memory_set_aside.h"
#include "engine/core/array/round_up.h"

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace episcope {
namespace {

constexpr std::size_t kHugePage = std::size_t{2} << 20;
constexpr std::size_t kCacheLine = 64;
// Less is never worth a file.
constexpr std::size_t kLeastOnDisk = std::size_t{1} << 20;
constexpr std::size_t kLeastUnasked = std::size_t{256} << 20;

// Of arrays that could have gone to disk, and what is set aside.
std::atomic<std::size_t> in_memory{0};

bool is_counted(std::size_t bytes) {
  return bytes >= kLeastOnDisk;
}

bool fits_budget(std::size_t bytes) {
  if (!is_counted(bytes)) return true;
  if (is_memory_budget_set()) return in_memory + bytes <= memory_budget();
  return bytes < kLeastUnasked || bytes <= memory_budget();
}

LargeMemory counted(LargeMemory memory) {
  if (is_counted(memory.bytes)) in_memory += memory.bytes;
  return memory;
}

}  // namespace

LargeMemory allocate_large(std::size_t bytes) {
  if (!fits_budget(bytes)) return {map_scratch(bytes), bytes, LargeKind::Scratch};
  const bool huge = bytes >= 2 * kHugePage;
  const std::size_t alignment = huge ? kHugePage : kCacheLine;
  const std::size_t rounded = round_up(bytes, alignment);
  void* memory = std::aligned_alloc(alignment, rounded > 0 ? rounded : alignment);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  // Only a hint: where it is refused, the memory is ordinary.
  if (huge) madvise(memory, rounded, MADV_HUGEPAGE);
#endif
  return counted({memory, bytes, LargeKind::Heap});
}

LargeMemory allocate_large_zeros(std::size_t bytes) {
  if (bytes >= 2 * kHugePage) return {map_zeros(bytes), bytes, LargeKind::Zeros};
  const LargeMemory memory = allocate_large(bytes);
  std::memset(memory.data, 0, bytes);
  return memory;
}

LargeMemory large_part_of_file(const std::filesystem::path& path, std::uintmax_t offset,
                               std::size_t bytes) {
  return {map_file(path, offset, bytes), bytes, LargeKind::File};
}

void release_large(const LargeMemory& memory) noexcept {
  if (memory.kind != LargeKind::Heap) {
    unmap(memory.data, memory.bytes);
    return;
  }
  std::free(memory.data);
  if (memory.data != nullptr && is_counted(memory.bytes)) in_memory -= memory.bytes;
}

void take_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(MADV_POPULATE_WRITE)
  // The system wants whole pages: those that begin in the piece.
  constexpr std::size_t kPage = 4096;
  const auto begin = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t first = round_up(begin, kPage), end = round_up(begin + bytes, kPage);
  if (first < end)
    madvise(static_cast<char*>(memory) + (first - begin), end - first, MADV_POPULATE_WRITE);
#endif
}

MemorySetAside::MemorySetAside(std::size_t bytes) noexcept : bytes_(bytes) {
  in_memory += bytes_;
}

MemorySetAside::~MemorySetAside() {
  in_memory -= bytes_;
}

}  // namespace episcope
