// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace episcope::io {

/// Refuses views that fit neither into the memory of the machine nor, unpacked, into its scratch
/// folder. The system would not refuse them at once: it would end the program later. Throws IoError
/// for `path`.
void require_view_memory(const std::filesystem::path& path, double bytes);

}  // namespace episcope::io
