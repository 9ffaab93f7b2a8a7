// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/gui/bench/workbench.h"
#include "engine/core/light_field/light_field.h"

#include <QObject>
#include <QStringList>

#include <optional>

namespace episcope {

class ValueBar;

/// Shows the values of the pixel under the cursor (of the cross-hair while the cursor is
/// elsewhere), prints values into large pixels, and counts the running jobs.
class ValueController : public QObject {
  Q_OBJECT

 public:
  explicit ValueController(const Workbench& bench);

 private:
  void show();
  void showStatus();
  [[nodiscard]] QStringList pixelText(PixelIndex pixel) const;

  Workbench bench_;
  Session& session_;
  ValueBar* bar_;
  std::optional<PixelIndex> cursor_;
};

}  // namespace episcope
