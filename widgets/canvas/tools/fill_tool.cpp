// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/canvas/tools/fill_tool.h"

namespace episcope {

void FillTool::press(const ToolPress& press) {
  emit fillRequested(
      {press.at, press.button == Qt::RightButton, press.modifiers.testFlag(Qt::ShiftModifier)});
}

}  // namespace episcope

#include "moc_fill_tool.cpp"
