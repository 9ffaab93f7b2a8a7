// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QProxyStyle>

namespace episcope {

/// The Fusion style, with frames of check boxes that are seen in a dark theme as well: Fusion draws
/// them darker than the window, whatever that is. Tabs stand closer together, and buttons of
/// dialogs have no icons, which Fusion draws dark, too. Handles of splitters are a short line in
/// the middle instead of a row of dark dots as wide as the handle. Names that are too long for a
/// combo box end in "…".
class OutlinedStyle : public QProxyStyle {
  Q_OBJECT

 public:
  OutlinedStyle();

  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget = nullptr) const override;
  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget = nullptr) const override;
  int pixelMetric(PixelMetric metric, const QStyleOption* option = nullptr,
                  const QWidget* widget = nullptr) const override;
  int styleHint(StyleHint hint, const QStyleOption* option = nullptr,
                const QWidget* widget = nullptr, QStyleHintReturn* data = nullptr) const override;
};

}  // namespace episcope
