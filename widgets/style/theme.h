// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QPalette>

namespace episcope::theme {

/// Colours of our own dark canvases, which do not follow the desktop theme.
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

/// Whether the palette is a dark one.
[[nodiscard]] bool is_dark(const QPalette& palette);
/// Text of lesser weight, still legible: contrast ≥ 4.5 against window and tabs.
[[nodiscard]] QColor muted_text(const QPalette& palette);
/// Frames of controls that nothing else sets off: contrast ≥ 3 against window and tabs, less where
/// they are disabled.
[[nodiscard]] QColor frame(const QPalette& palette);
/// Text colours of meanings, legible on the palette's window.
[[nodiscard]] QColor error_text(const QPalette& palette);
[[nodiscard]] QColor warning_text(const QPalette& palette);
[[nodiscard]] QColor success_text(const QPalette& palette);

/// `part` of the way from one colour to the other.
[[nodiscard]] QColor blend(const QColor& from, const QColor& to, double part);

/// A palette that sets nothing but the colour of labels, so that all else is still inherited.
[[nodiscard]] QPalette text_palette(const QColor& color);

/// Contrast ratio of two opaque colours, 1 … 21 (WCAG 2.1, relative luminance).
[[nodiscard]] double contrast_ratio(const QColor& a, const QColor& b);

/// Complete light and dark palettes, for `--theme` options, screenshots and tests.
[[nodiscard]] QPalette light_palette();
[[nodiscard]] QPalette dark_palette();

}  // namespace episcope::theme
