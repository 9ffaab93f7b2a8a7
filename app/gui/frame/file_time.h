// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

#include <filesystem>

namespace episcope {

/// When a file was changed, as local date and time in the short form of the user's language.
[[nodiscard]] QString short_text(std::filesystem::file_time_type time);

}  // namespace episcope
