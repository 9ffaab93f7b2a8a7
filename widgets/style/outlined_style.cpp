// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/style/outlined_style.h"

#include "widgets/style/theme.h"

#include <QPainter>
#include <QStyleOption>

namespace episcope {
namespace {

constexpr int kTabSpace = 12;  // Left and right of the text together.
constexpr int kIconSpace = 4;  // Between icon and text of a combo box.
constexpr int kTextMargin = 1;
constexpr int kGripLength = 24;
constexpr int kGripWidth = 2;

// What a handle is held by; room is left on either side of it.
void draw_grip(const QStyleOption& handle, QPainter& painter) {
  QRect grip(0, 0, kGripWidth, kGripLength);
  if (handle.rect.width() > handle.rect.height()) grip = grip.transposed();
  grip.setSize(grip.size().boundedTo(handle.rect.size()));
  grip.moveCenter(handle.rect.center());
  painter.fillRect(grip, theme::frame(handle.palette));
}

// With as much of the text as there is room for.
QStyleOptionComboBox elided(const QStyleOptionComboBox& box, const QRect& field) {
  QStyleOptionComboBox fitting = box;
  const int icon = box.currentIcon.isNull() ? 0 : box.iconSize.width() + kIconSpace;
  fitting.currentText = box.fontMetrics.elidedText(box.currentText, Qt::ElideRight,
                                                   field.width() - icon - 2 * kTextMargin);
  return fitting;
}

}  // namespace

OutlinedStyle::OutlinedStyle() : QProxyStyle("Fusion") {}

void OutlinedStyle::drawControl(ControlElement element, const QStyleOption* option,
                                QPainter* painter, const QWidget* widget) const {
  if (element == CE_Splitter) {
    draw_grip(*option, *painter);
  } else if (const auto* box = qstyleoption_cast<const QStyleOptionComboBox*>(option);
             box && element == CE_ComboBoxLabel) {
    const QRect field = subControlRect(CC_ComboBox, box, SC_ComboBoxEditField, widget);
    const QStyleOptionComboBox fitting = elided(*box, field);
    QProxyStyle::drawControl(element, &fitting, painter, widget);
  } else {
    QProxyStyle::drawControl(element, option, painter, widget);
  }
}

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
