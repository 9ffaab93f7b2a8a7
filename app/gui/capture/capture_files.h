// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include <filesystem>

namespace episcope {

class Messages;

[[nodiscard]] std::filesystem::path path_of(const QString& path);

/// Whether a light field can be written there: its name ends in .h5 and nothing has it yet, so that
/// none is lost; if not, the user is told.
[[nodiscard]] bool is_new_light_field(const QString& path, Messages& messages);

}  // namespace episcope
