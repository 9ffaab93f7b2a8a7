// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QIcon>
#include <QPalette>
#include <QProxyStyle>
#include <QRectF>
#include <QString>

#include <functional>

class QObject;
class QPainter;
class QWidget;

namespace episcope::theme {

/// Colors of our dark canvases, which ignore the desktop theme.
inline constexpr QColor kCanvas{0x26, 0x28, 0x2b};
inline constexpr QColor kCanvasText{0xd6, 0xd9, 0xdd};
inline constexpr QColor kCanvasMuted{0x9a, 0xa0, 0xa8};
inline constexpr QColor kCrossHair{0xff, 0xd1, 0x4a};
inline constexpr QColor kEstimate{0x4a, 0xc8, 0xff};  ///< Slope of the estimate.
inline constexpr QColor kTruth{0x7d, 0xe0, 0x6b};     ///< Slope of the truth.
inline constexpr QColor kPainted{0xff, 0x6a, 0x3d};   ///< Marks views that are painted.
inline constexpr QColor kMeasured{0xff, 0x8b, 0xd1};  ///< A line drawn by hand.

inline constexpr int kSpacing = 6;  ///< Between controls, logical pixels.
inline constexpr int kMargin = 8;   ///< Around groups.

[[nodiscard]] bool is_dark(const QPalette& palette);
/// Less prominent text, still legible: contrast ≥ 4.5 against window and tabs.
[[nodiscard]] QColor muted_text(const QPalette& palette);
/// Frame color of controls: contrast ≥ 3 against window and tabs, less if disabled.
[[nodiscard]] QColor frame(const QPalette& palette);
/// Text colors for errors, warnings and success, legible on the palette's window.
[[nodiscard]] QColor error_text(const QPalette& palette);
[[nodiscard]] QColor warning_text(const QPalette& palette);
[[nodiscard]] QColor success_text(const QPalette& palette);

/// Interpolates between two colors; `part` in [0, 1].
[[nodiscard]] QColor blend(const QColor& from, const QColor& to, double part);

/// Palette that sets only the color of labels and inherits the rest.
[[nodiscard]] QPalette text_palette(const QColor& color);
/// Calls `follow` now and whenever the palette of a widget changes, as long as there is `context`.
void follow_palette(QWidget* widget, QObject* context, std::function<void()> follow);
/// Gives a label `muted_text` in the palette of its parent, whatever that becomes.
void mute(QWidget* label);

/// Contrast ratio of two opaque colors, 1 … 21 (WCAG 2.1, relative luminance).
[[nodiscard]] double contrast_ratio(const QColor& a, const QColor& b);

/// Complete light and dark palettes, for `--theme` options, screenshots and tests.
[[nodiscard]] QPalette light_palette();
[[nodiscard]] QPalette dark_palette();

}  // namespace episcope::theme

namespace episcope {

/// The two compared results: A is shown, B is compared with it.
enum class Side { None, A, B };

/// Blue for A, orange for B: distinct on any picture and for the color-blind.
[[nodiscard]] QColor side_color(Side side);
/// The letter on its color, for lists; null for None.
[[nodiscard]] QIcon side_icon(Side side);
/// Draws the letter on its color.
void draw_side(QPainter& painter, const QRectF& badge, Side side);

/// The Fusion style with changes for dark themes and little room: visible frames of check boxes,
/// tabs closer together, no icons on dialog buttons, a short line as splitter handle, and long
/// names in combo boxes that end in "…".
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
