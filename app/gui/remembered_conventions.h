// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/io/open/open.h"

#include <QString>

namespace episcope {

/// Whether the user overrules anything that a reader would find out by itself.
[[nodiscard]] bool overrules(const io::OpenOptions& conventions);

/// What the user chose for this file or folder; all automatic if nothing was. `path` is absolute.
[[nodiscard]] io::OpenOptions remembered_conventions(const QString& path);

/// Keeps the choice for later opens; one that overrules nothing is forgotten.
void remember_conventions(const QString& path, const io::OpenOptions& conventions);

}  // namespace episcope
