// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/label_info.h"

#include <QIcon>
#include <QIconEngine>
#include <QPalette>
#include <QString>

namespace episcope {

/// An icon of resources/icons by name ("open", "play", …), drawn in the text colour of the palette
/// at hand, so that it follows light and dark themes. An unknown name gives a null icon.
[[nodiscard]] QIcon themed_icon(const QString& name);

/// The program's own icon, for its windows.
[[nodiscard]] QIcon program_icon();

/// An icon that is painted at every size anew, and once for each. Qt's own engine leaves the ground
/// of a pixmap undefined; here it is transparent.
class PaintedIconEngine : public QIconEngine {
 public:
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) final;

 protected:
  /// What tells this picture from that of any other icon, its colours included.
  [[nodiscard]] virtual QString look(QIcon::Mode mode) const = 0;
};

/// Size of a swatch, logical pixels.
inline constexpr int kSwatchSize = 16;

/// The colour of a label as an icon; the same where its row is selected.
[[nodiscard]] QIcon swatch(const Rgb& rgb, const QPalette& palette);

}  // namespace episcope
