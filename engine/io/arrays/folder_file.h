// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>

namespace episcope::io {

/// The only file of a folder that is meant, if there are no images beside it; else empty.
[[nodiscard]] std::filesystem::path only_file_in(
    const std::filesystem::path& folder,
    const std::function<bool(const std::filesystem::path&)>& is_meant);

}  // namespace episcope::io
