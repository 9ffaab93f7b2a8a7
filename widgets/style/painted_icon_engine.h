// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QIconEngine>

namespace episcope {

/// An icon that is painted anew at every size. Qt's own engine leaves the ground of a pixmap
/// undefined; here it is transparent.
class PaintedIconEngine : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) final;
};

}  // namespace episcope
