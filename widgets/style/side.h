// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QIcon>
#include <QRectF>
#include <QString>

class QPainter;

namespace episcope {

/// The two that are compared: A is the result shown, B the one it is compared with.
enum class Side { None, A, B };

/// "A", "B" or nothing.
[[nodiscard]] QString side_letter(Side side);
/// Blue for A, orange for B: told apart on any picture and by the colour-blind.
[[nodiscard]] QColor side_color(Side side);
/// The letter on its colour, for lists; null for None.
[[nodiscard]] QIcon side_icon(Side side);
/// Draws the letter on its colour.
void draw_side(QPainter& painter, const QRectF& badge, Side side);

}  // namespace episcope
