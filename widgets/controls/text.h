// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"
#include "engine/core/scene.h"
#include "engine/render/quantity.h"

#include <QString>

#include <string>
#include <vector>

namespace episcope {

inline constexpr QChar kMinus(0x2212);

/// Displayed form of a number: with a true minus, none before zero after rounding, and an exponent
/// from ten million on.
[[nodiscard]] QString number_text(double value, int decimals = 3);

/// Replaces hyphens before numbers by a true minus; hyphens in words, names and exponents stay.
[[nodiscard]] QString with_minus(QString sentence);

/// Texts of the table of quantities (engine/render/quantity.h), translated.

/// Name within a sentence: "signed error"; "none" for Quantity::View.
[[nodiscard]] QString quantity_label(render::Quantity quantity);
/// Name on a button: "Error".
[[nodiscard]] QString quantity_button(render::Quantity quantity);
[[nodiscard]] QString quantity_tip(render::Quantity quantity);
/// Unit: "px"; empty without one.
[[nodiscard]] QString quantity_unit(render::Quantity quantity);

/// Translates a schema's label, help, unit or choice, a sentence on a method, or the name of a file
/// kind. The engine holds these in English; translations have the context "episcope::Schema".
[[nodiscard]] QString schema_text(const std::string& text);

/// A note or warning of the engine in the language of the window; a sentence that is not among
/// `kFindingTexts` is looked up as `schema_text`. With true minus signs.
[[nodiscard]] QString finding_words(const std::string& sentence);

/// Name of a label; "label 3", translated, if it has none of its own (default_label).
[[nodiscard]] QString label_name(const LabelInfo& label);

/// The same in one short line, such as "Using the inner 10×10 of 14×14 views"; empty if there is
/// none.
[[nodiscard]] QString finding_brief(const std::string& sentence);

/// Displayed form of a value: "on" or "off", "auto", the label of a choice, a number with its unit.
[[nodiscard]] QString value_text(const ParameterDescription& description,
                                 const ParameterValue& value);

/// "Inner scale", as the form names it; the key if it is not described.
[[nodiscard]] QString parameter_label(const std::vector<ParameterDescription>& descriptions,
                                      const std::string& key);

/// "Inner scale 0.8 px", as the form names it; key and value if it is not described.
[[nodiscard]] QString labeled_value_text(const std::vector<ParameterDescription>& descriptions,
                                         const std::string& key, const ParameterValue& value);

/// Domain of a number or an interval, "0 … 10 px"; empty for other types.
[[nodiscard]] QString domain_text(const ParameterDescription& description);

/// A name with a warning sign.
[[nodiscard]] inline QString warned_name(const QString& name) {
  return QStringLiteral("⚠ ") + name;
}

/// Adds invisible break opportunities to long words: after the marks of names and paths, and within
/// words that are too long. For display only, not for copying.
[[nodiscard]] QString breakable(const QString& text);

}  // namespace episcope
