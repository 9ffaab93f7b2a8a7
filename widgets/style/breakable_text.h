// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>

namespace episcope {

/// The text with invisible places to break in its long words: after the marks of names and paths,
/// and wherever a word would go on for too long without one. For showing only, not for copying.
[[nodiscard]] QString breakable(const QString& text);

}  // namespace episcope
