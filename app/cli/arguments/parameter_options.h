// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <map>
#include <string>
#include <vector>

namespace episcope::cli {

class Arguments;

/// Options generated from a schema: `--<key> VALUE`, and `--<key>` alone for toggles.
class ParameterOptions {
 public:
  /// To be called once for each heading; the object must outlive the parsing.
  void declare(Arguments& arguments, const std::string& heading,
               const std::vector<ParameterDescription>& parameters);
  /// Values of the options that were given. Throws UsageError for one outside its domain.
  [[nodiscard]] ParameterSet values() const;

 private:
  std::vector<ParameterDescription> parameters_;
  std::map<std::string, std::string> texts_;  // by key; empty = not given
  std::map<std::string, bool> toggles_;       // by key
};

/// Whether `min` and `max` of a parameter say something.
[[nodiscard]] bool has_numeric_domain(const ParameterDescription& parameter);

/// "0.1 … 4 px", "auto or A,B from -8 to 8 px", "a|b|c", "true|false".
[[nodiscard]] std::string domain_text(const ParameterDescription& parameter);

}  // namespace episcope::cli
