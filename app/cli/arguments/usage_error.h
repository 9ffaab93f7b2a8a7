// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/error.h"

#include <string>
#include <vector>

namespace episcope::cli {

/// The command line itself is wrong: exit code 2.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// "there is no <kind> '<name>'; did you mean '<nearest>'?" or, if none is near, the list of names.
[[nodiscard]] UsageError unknown_name(const std::string& kind, const std::string& name,
                                      const std::vector<std::string>& names);

}  // namespace episcope::cli
