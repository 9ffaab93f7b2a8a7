// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

namespace episcope {

/// A number as it is shown: with a true minus, and without one before what is rounded to zero.
[[nodiscard]] QString number_text(double value, int decimals = 3);

}  // namespace episcope
