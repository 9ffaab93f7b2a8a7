// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/disparity/estimator.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace episcope::cli {

class Arguments;

/// Options generated from a schema: `--<key> VALUE`, and `--<key>` alone for toggles.
class ParameterOptions {
 public:
  /// Under the present heading of the arguments; the object must outlive the parsing. `names` has
  /// options of another name than their key, which stays valid as an earlier name.
  void declare(Arguments& arguments, const std::vector<ParameterDescription>& parameters,
               const std::map<std::string, std::string>& names = {});
  /// Values of the options that were given, in the order of declaration.
  [[nodiscard]] ParameterSet values() const;
  [[nodiscard]] bool is_given(const std::string& key) const;

 private:
  std::vector<std::string> keys_;
  std::map<std::string, std::optional<ParameterValue>> values_;  // by key; empty = not given
};

/// "0.1 … 4 px", "auto or A,B in -8 … 8 px", "a|b|c", "true|false".
[[nodiscard]] std::string domain_text(const ParameterDescription& parameter);

/// Methods by their ids, each once. Throws UsageError for an unknown one.
[[nodiscard]] std::vector<Estimator> methods_named(const std::vector<std::string>& ids);

}  // namespace episcope::cli
