// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/render/quantity.h"

#include <QString>

namespace episcope {

/// Texts of the table of quantities (engine/render/quantity.h), translated.

/// As in a sentence: "signed error"; "none" for Quantity::View.
[[nodiscard]] QString quantity_label(render::Quantity quantity);
/// As on a button: "Error".
[[nodiscard]] QString quantity_button(render::Quantity quantity);
[[nodiscard]] QString quantity_tip(render::Quantity quantity);
/// "px"; empty where numbers have no unit.
[[nodiscard]] QString quantity_unit(render::Quantity quantity);

}  // namespace episcope
