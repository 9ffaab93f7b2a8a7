// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QString>

#include <string>

namespace episcope {

/// A label, help, unit or choice of a schema, a sentence on a method, or the name of a file kind.
/// The engine holds these in English; translations of them are looked up in the context
/// "episcope::Schema".
[[nodiscard]] QString schema_text(const std::string& text);

/// A value as users read it: "on" or "off", "auto", the label of a choice, a number with its unit.
[[nodiscard]] QString value_text(const ParameterDescription& description,
                                 const ParameterValue& value);

/// The domain of a number or an interval, "0 … 10 px"; empty for parameters of other types.
[[nodiscard]] QString domain_text(const ParameterDescription& description);

}  // namespace episcope
