// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

namespace episcope {

/// How much memory light fields and other large arrays may take before they go to disk
/// (large_memory.h). There is one budget for the whole process, because there is one memory: it is
/// set when a program starts, and changes no result.

/// Bytes that could be taken now without driving out other programs: what the system calls
/// available, or what the control group of the process leaves if that is less.
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

/// Where arrays go that do not fit: a folder on a disk, made when it is first needed. By default
/// that of temporary files.
void set_scratch_folder(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path scratch_folder();

}  // namespace episcope
