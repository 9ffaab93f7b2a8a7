// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

namespace episcope {

/// What a result file says of its light field: a built-in scene as it is typed, else a path
/// relative to the folder of the result, so that both can move together; absolute only where they
/// share no folder but the root. Its last part is the name; the hash of the samples is beside it.
[[nodiscard]] std::string source_text(const std::string& input,
                                      const std::filesystem::path& result);

/// The INPUT behind a `source` that was read from the file `result`; empty if there is none or it
/// is not where it was.
[[nodiscard]] std::string existing_source(const std::string& source,
                                          const std::filesystem::path& result);

}  // namespace episcope
