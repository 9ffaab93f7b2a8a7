// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>

namespace episcope {

/// What went wrong in a computation, in words for the user.
[[nodiscard]] std::string failure_text(const std::exception_ptr& failure);

}  // namespace episcope
