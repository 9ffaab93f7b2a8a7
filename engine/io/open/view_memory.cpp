// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/view_memory.h"

#include "engine/core/array/memory_budget.h"
#include "engine/core/error.h"

#include <fmt/format.h>

#include <unistd.h>
#include <algorithm>

namespace episcope::io {
namespace {

/// Of the nearest folder that is there.
double room_in(std::filesystem::path folder) {
  std::error_code error;
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  const auto space = std::filesystem::space(folder, error);
  return error ? 0 : static_cast<double>(space.available);
}

}  // namespace

void require_view_memory(const std::filesystem::path& path, double bytes) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes < memory) return;
  const double room = room_in(scratch_folder());
  if (bytes < room) return;
  constexpr double gigabyte = 1e9;
  throw IoError(
      path,
      fmt::format("the views need {:.1f} GB, but this machine has {:.1f} GB of memory and "
                  "{:.1f} GB of room in {}; make room there, or store fewer views or "
                  "smaller ones",
                  bytes / gigabyte, memory / gigabyte, room / gigabyte, scratch_folder().string()));
}

}  // namespace episcope::io
