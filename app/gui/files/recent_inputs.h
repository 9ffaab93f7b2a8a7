// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QString>
#include <QStringList>

namespace episcope {

/// What was opened before, newest first, as the settings keep it.
[[nodiscard]] QStringList recent_inputs();

void remember_recent(const QString& input);
void forget_recent();

}  // namespace episcope
