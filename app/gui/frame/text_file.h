// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QString;

namespace episcope {

/// Writes UTF-8 text. Atomic. Throws IoError.
void write_text_file(const QString& path, const QString& text);

}  // namespace episcope
