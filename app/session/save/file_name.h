// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace episcope {

/// A name as any file system takes it: without separators and the like, in UTF-8, and not too long.
[[nodiscard]] std::string file_name_of(std::string name);

}  // namespace episcope
