// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <string>
#include <vector>

namespace episcope {

/// Whether a sweep can vary a parameter: it is a number.
[[nodiscard]] bool can_sweep(const ParameterDescription& description);

/// Reads what a sweep tries: values after commas or spaces, "0.1, 0.2, 0.4"; or a range with the
/// number of values, "0.1:1.6:5", evenly or in powers as the description says. Ascending, none
/// twice. Throws InvalidInput, a sentence, for what is not a value of the parameter or in no form.
[[nodiscard]] std::vector<ParameterValue> parse_sweep_values(
    const ParameterDescription& description, const std::string& text);

/// What to try first, as text that can be read back: what a search tries, else five values around
/// the present one within the domain.
[[nodiscard]] std::string proposed_sweep_values(const ParameterDescription& description);

/// A number of a value that `can_sweep`.
[[nodiscard]] double number_of(const ParameterValue& value);

}  // namespace episcope
