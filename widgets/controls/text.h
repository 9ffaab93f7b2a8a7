// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/render/quantity.h"

#include <QString>

#include <string>

namespace episcope {

inline constexpr QChar kMinus(0x2212);

/// A number as it is shown: with a true minus, without one before what is rounded to zero, and with
/// an exponent from ten millions on.
[[nodiscard]] QString number_text(double value, int decimals = 3);

/// A sentence with a true minus before its numbers; hyphens within words, names and exponents stay.
[[nodiscard]] QString with_minus(QString sentence);

/// Texts of the table of quantities (engine/render/quantity.h), translated.

/// As in a sentence: "signed error"; "none" for Quantity::View.
[[nodiscard]] QString quantity_label(render::Quantity quantity);
/// As on a button: "Error".
[[nodiscard]] QString quantity_button(render::Quantity quantity);
[[nodiscard]] QString quantity_tip(render::Quantity quantity);
/// "px"; empty where numbers have no unit.
[[nodiscard]] QString quantity_unit(render::Quantity quantity);

/// A label, help, unit or choice of a schema, a sentence on a method, or the name of a file kind.
/// The engine holds these in English; translations of them are looked up in the context
/// "episcope::Schema".
[[nodiscard]] QString schema_text(const std::string& text);

/// A value as users read it: "on" or "off", "auto", the label of a choice, a number with its unit.
[[nodiscard]] QString value_text(const ParameterDescription& description,
                                 const ParameterValue& value);

/// The domain of a number or an interval, "0 … 10 px"; empty for parameters of other types.
[[nodiscard]] QString domain_text(const ParameterDescription& description);

/// The text with invisible places to break in its long words: after the marks of names and paths,
/// and wherever a word would go on for too long without one. For showing only, not for copying.
[[nodiscard]] QString breakable(const QString& text);

}  // namespace episcope
