// SPDX-License-Identifier: BSD-3-Clause
#include "engine/io/open/view_memory.h"

#include "engine/core/error.h"

#include <fmt/format.h>
#include <unistd.h>

namespace episcope::io {

void require_view_memory(const std::filesystem::path& path, double bytes) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes < memory) return;
  constexpr double gigabyte = 1e9;
  throw IoError(path,
                fmt::format("the views need {:.1f} GB of memory, but this machine has {:.1f} GB; "
                            "store fewer views or smaller ones",
                            bytes / gigabyte, memory / gigabyte));
}

}  // namespace episcope::io
