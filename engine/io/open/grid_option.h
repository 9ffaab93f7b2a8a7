// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/open_options.h"

#include <optional>
#include <string>

namespace episcope::io {

/// "7×7", for sentences.
[[nodiscard]] std::string grid_text(GridShape grid);

/// Rows and columns as a user writes them: "7x7", "1x49". Throws InvalidInput for anything else,
/// and for more than 1,000,000 views.
[[nodiscard]] GridShape parse_grid(const std::string& text);

/// The option `grid`; nothing if it was not given. Throws InvalidInput.
[[nodiscard]] std::optional<GridShape> given_grid(const OpenOptions& options);

}  // namespace episcope::io
