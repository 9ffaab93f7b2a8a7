// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/outlined_style.h"

#include "widgets/style/theme.h"

#include <QPainter>
#include <QStyleOption>

namespace episcope {
namespace {

constexpr int kTabSpace = 12;  // Left and right of the text together.

}  // namespace

OutlinedStyle::OutlinedStyle() : QProxyStyle("Fusion") {}

void OutlinedStyle::drawPrimitive(PrimitiveElement element, const QStyleOption* option,
                                  QPainter* painter, const QWidget* widget) const {
  QProxyStyle::drawPrimitive(element, option, painter, widget);
  if (element != PE_IndicatorCheckBox) return;
  const bool has_focus =
      option->state.testFlag(State_HasFocus) && option->state.testFlag(State_KeyboardFocusChange);
  painter->save();
  painter->setPen(has_focus ? option->palette.color(QPalette::Highlight)
                            : theme::frame(option->palette));
  painter->setRenderHint(QPainter::Antialiasing);
  painter->drawRect(QRectF(option->rect).adjusted(0.5, 0.5, -0.5, -0.5));
  painter->restore();
}

int OutlinedStyle::pixelMetric(PixelMetric metric, const QStyleOption* option,
                               const QWidget* widget) const {
  if (metric == PM_TabBarTabHSpace) return kTabSpace;
  return QProxyStyle::pixelMetric(metric, option, widget);
}

int OutlinedStyle::styleHint(StyleHint hint, const QStyleOption* option, const QWidget* widget,
                             QStyleHintReturn* data) const {
  if (hint == SH_DialogButtonBox_ButtonsHaveIcons) return 0;
  return QProxyStyle::styleHint(hint, option, widget, data);
}

}  // namespace episcope

#include "moc_outlined_style.cpp"
