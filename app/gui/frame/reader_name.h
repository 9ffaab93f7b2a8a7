// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class QWidget;

namespace episcope {

/// Gives a control a name that screen readers can tell: what has neither a text, nor a label, nor a
/// name of its own is called as the first line of its tool tip says.
void name_for_readers(QWidget& control);

}  // namespace episcope
