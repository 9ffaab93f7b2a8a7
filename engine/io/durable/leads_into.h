// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// Whether a path is a folder, or something in it or below, when all links are followed. What does
/// not exist yet counts by the folders that do. No if that cannot be found out.
[[nodiscard]] bool leads_into(const std::filesystem::path& path,
                              const std::filesystem::path& folder);

}  // namespace episcope::io
