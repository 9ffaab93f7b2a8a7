// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "engine/core/parameter.h"

#include <QFrame>

class QPainter;

namespace episcope {

/// Label, help, domain, default and key of a parameter, as rich text.
[[nodiscard]] QString parameter_help(const ParameterDescription& description);

/// What the picture of the parameter of this key shows; empty if there is no picture.
[[nodiscard]] QString parameter_caption(const std::string& key);

/// Draws what a value of a parameter does: the slopes of a range, the window of a scale, a curve
/// that smoothing makes of noise. Schematic, without numbers. Nothing for a parameter without a
/// picture.
void draw_parameter(QPainter& painter, const QRectF& place, const ParameterDescription& description,
                    const ParameterValue& value);

/// A pop-up with the help of one parameter, and a picture of what its value does where there is
/// one. Escape or a click elsewhere closes it.
class ParameterHelp : public QFrame {
  Q_OBJECT

 public:
  ParameterHelp(const ParameterDescription& description, const ParameterValue& value,
                QWidget* parent);

  /// Opens with its upper right corner there, moved into the screen.
  void showAt(const QPoint& corner);
};

}  // namespace episcope
