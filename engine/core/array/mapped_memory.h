// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace episcope {

/// Memory whose contents are in a file: the system reads them when they are looked at and drops
/// them when memory is short. What lies behind the last byte can be read up to the next page, and
/// one page more.

/// `bytes` of a file from `offset` on. Writing there changes the memory, never the file, and takes
/// ordinary memory. Throws IoError if the file is shorter or cannot be mapped.
///
/// A file that is truncated while it is mapped has no samples there any more: they read as 0, and
/// `has_lost_pages` says so from then on.
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
