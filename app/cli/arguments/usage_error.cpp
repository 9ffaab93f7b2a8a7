// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/arguments/usage_error.h"

#include "engine/core/parameter/parameter.h"

namespace episcope::cli {

UsageError unknown_name(const std::string& kind, const std::string& name,
                        const std::vector<std::string>& names) {
  const std::string beginning = "there is no " + kind + " '" + name + "'; ";
  if (const std::string nearest = nearest_name(name, names); !nearest.empty()) {
    return UsageError(beginning + "did you mean '" + nearest + "'?");
  }
  std::string list;
  for (const auto& each : names) list += (list.empty() ? "" : ", ") + each;
  return UsageError(beginning + "use one of " + list);
}

}  // namespace episcope::cli
