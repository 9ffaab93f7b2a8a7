// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

namespace episcope {

inline constexpr QChar kMinus(0x2212);

/// A number as it is shown: with a true minus, without one before what is rounded to zero, and with
/// an exponent from ten millions on.
[[nodiscard]] QString number_text(double value, int decimals = 3);

/// A sentence with a true minus before its numbers; hyphens within words, names and exponents stay.
[[nodiscard]] QString with_minus(QString sentence);

}  // namespace episcope
