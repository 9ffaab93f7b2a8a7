// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <QColor>
#include <QPalette>

#include <cstddef>

namespace episcope {

/// How a line of a plot looks: colours of Okabe and Ito, which the colour-blind tell apart, and a
/// marker of its own, so that colour is not all there is.
struct SeriesLook {
  QColor color;  ///< Contrast ≥ 3 against the base of the palette.
  int marker;    ///< As in vtkPlotPoints.
};

/// They repeat after six.
[[nodiscard]] SeriesLook series_look(std::size_t series, const QPalette& palette);

}  // namespace episcope
