// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter/parameter.h"

#include <QString>

namespace episcope {

/// The reading options (io::open_schema) that the user set for this file or folder; none if all are
/// automatic. `path` is absolute.
[[nodiscard]] ParameterSet remembered_conventions(const QString& path);

/// Keeps the options for later opens; without any, the file is forgotten.
void remember_conventions(const QString& path, const ParameterSet& given);

}  // namespace episcope
