// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/controls/theme.h"

#include "widgets/controls/tool_button.h"

#include <QEvent>
#include <QPainter>
#include <QStyleOption>
#include <QWidget>

#include <algorithm>
#include <cmath>
#include <utility>

namespace episcope::theme {
namespace {

double luminance(const QColor& color) {
  const auto linear = [](double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(color.redF()) + 0.7152 * linear(color.greenF()) +
         0.0722 * linear(color.blueF());
}

struct Surfaces {
  QColor window, base, alternate, button, text, disabled, highlight, highlighted_text, link;
};

QPalette make_palette(const Surfaces& s) {
  QPalette palette(s.text, s.button, s.button.lighter(130), s.button.darker(160),
                   s.button.darker(120), s.text, s.base, s.base, s.window);
  palette.setColor(QPalette::AlternateBase, s.alternate);
  palette.setColor(QPalette::ButtonText, s.text);
  palette.setColor(QPalette::ToolTipBase, s.base);
  palette.setColor(QPalette::ToolTipText, s.text);
  palette.setColor(QPalette::Highlight, s.highlight);
  palette.setColor(QPalette::HighlightedText, s.highlighted_text);
  palette.setColor(QPalette::Link, s.link);
  palette.setColor(QPalette::LinkVisited, s.link);
  palette.setColor(QPalette::PlaceholderText, s.disabled);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
    palette.setColor(QPalette::Disabled, role, s.disabled);
  }
  return palette;
}

/// Text as faint as it may be against windows and panes; `least` is the part of it to begin with.
QColor text_of_contrast(const QPalette& palette, double contrast, double least) {
  const QColor window = palette.color(QPalette::Window);
  const QColor text = palette.color(QPalette::WindowText);
  // Tabs and group boxes are drawn in shades of the button color.
  const QColor pane = palette.color(QPalette::Button).lighter(is_dark(palette) ? 128 : 104);
  for (double part = least; part < 1; part += 0.05) {
    const QColor color = blend(window, text, part);
    if (contrast_ratio(window, color) >= contrast && contrast_ratio(pane, color) >= contrast) {
      return color;
    }
  }
  return text;
}

class PaletteFollower : public QObject {
 public:
  PaletteFollower(QObject* parent, std::function<void()> follow)
      : QObject(parent), follow_(std::move(follow)) {}

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::PaletteChange) follow_();
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> follow_;
};

}  // namespace

bool is_dark(const QPalette& palette) {
  return luminance(palette.color(QPalette::Window)) <
         luminance(palette.color(QPalette::WindowText));
}

double contrast_ratio(const QColor& a, const QColor& b) {
  const double first = luminance(a);
  const double second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

QColor blend(const QColor& from, const QColor& to, double part) {
  const auto mix = [part](double a, double b) { return static_cast<float>(a + (b - a) * part); };
  return QColor::fromRgbF(mix(from.redF(), to.redF()), mix(from.greenF(), to.greenF()),
                          mix(from.blueF(), to.blueF()));
}

QPalette text_palette(const QColor& color) {
  QPalette palette;
  palette.setColor(QPalette::WindowText, color);
  return palette;
}

void follow_palette(QWidget* widget, QObject* context, std::function<void()> follow) {
  follow();
  widget->installEventFilter(new PaletteFollower(context, std::move(follow)));
}

void mute(QWidget* label) {
  QWidget* parent = label->parentWidget();
  follow_palette(parent, label, [label, parent] {
    label->setPalette(text_palette(muted_text(parent->palette())));
  });
}

QColor muted_text(const QPalette& palette) {
  constexpr double kLegible = 4.6;
  return text_of_contrast(palette, kLegible, 0.6);
}

QColor frame(const QPalette& palette) {
  constexpr double kVisible = 3;
  return text_of_contrast(palette, kVisible, 0.3);
}

QColor error_text(const QPalette& palette) {
  return is_dark(palette) ? QColor(0xff, 0x8f, 0x85) : QColor(0xa8, 0x1d, 0x16);
}

QColor warning_text(const QPalette& palette) {
  return is_dark(palette) ? QColor(0xff, 0xc4, 0x6b) : QColor(0x80, 0x50, 0x00);
}

QColor success_text(const QPalette& palette) {
  return is_dark(palette) ? QColor(0x86, 0xd9, 0x92) : QColor(0x19, 0x63, 0x28);
}

QPalette light_palette() {
  return make_palette({.window = {0xf4, 0xf5, 0xf6},
                       .base = {0xff, 0xff, 0xff},
                       .alternate = {0xf0, 0xf2, 0xf4},
                       .button = {0xec, 0xee, 0xf0},
                       .text = {0x1d, 0x20, 0x24},
                       .disabled = {0x8d, 0x93, 0x99},
                       .highlight = {0x1f, 0x6f, 0xb5},
                       .highlighted_text = {0xff, 0xff, 0xff},
                       .link = {0x1a, 0x5f, 0x9e}});
}

QPalette dark_palette() {
  return make_palette({.window = {0x30, 0x33, 0x37},
                       .base = {0x26, 0x28, 0x2b},
                       .alternate = {0x2c, 0x2f, 0x33},
                       .button = {0x3b, 0x3f, 0x44},
                       .text = {0xe4, 0xe6, 0xe9},
                       .disabled = {0x85, 0x8b, 0x92},
                       .highlight = {0x2f, 0x7d, 0xc4},
                       .highlighted_text = {0xff, 0xff, 0xff},
                       .link = {0x7f, 0xbd, 0xf2}});
}

}  // namespace episcope::theme

namespace episcope {
namespace {

// "A", "B" or nothing.
QString side_letter(Side side) {
  return side == Side::None ? QString() : QString(side == Side::A ? "A" : "B");
}

class SideIconEngine : public PaintedIconEngine {
 public:
  explicit SideIconEngine(Side side) : side_(side) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode, QIcon::State) override {
    draw_side(*painter, rect, side_);
  }
  [[nodiscard]] QIconEngine* clone() const override { return new SideIconEngine(side_); }

 protected:
  [[nodiscard]] QString look(QIcon::Mode) const override { return "side " + side_letter(side_); }

 private:
  Side side_;
};

}  // namespace

QColor side_color(Side side) {
  return side == Side::B ? QColor(0xb4, 0x53, 0x09) : QColor(0x1d, 0x64, 0xb4);
}

QIcon side_icon(Side side) {
  return side == Side::None ? QIcon() : QIcon(new SideIconEngine(side));
}

void draw_side(QPainter& painter, const QRectF& badge, Side side) {
  if (side == Side::None) return;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(side_color(side));
  painter.drawRoundedRect(badge, 3, 3);
  QFont font = painter.font();
  font.setBold(true);
  font.setPixelSize(static_cast<int>(std::max(8.0, badge.height() * 0.72)));
  painter.setFont(font);
  painter.setPen(Qt::white);
  painter.drawText(badge, Qt::AlignCenter, side_letter(side));
  painter.restore();
}

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

// Elides the text to the available room.
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

#include "moc_theme.cpp"
