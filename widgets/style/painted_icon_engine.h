// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QIconEngine>

namespace episcope {

/// An icon that is painted at every size anew, and once for each. Qt's own engine leaves the ground
/// of a pixmap undefined; here it is transparent.
class PaintedIconEngine : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) final;

 protected:
  /// What tells this picture from that of any other icon, its colours included.
  [[nodiscard]] virtual QString look(QIcon::Mode mode) const = 0;
};

}  // namespace episcope
