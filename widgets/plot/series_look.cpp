// SPDX-License-Identifier: BSD-3-Clause
#include "widgets/plot/series_look.h"

#include "widgets/style/theme.h"

#include <vtkPlotPoints.h>

#include <array>

namespace episcope {

SeriesLook series_look(std::size_t series, const QPalette& palette) {
  constexpr std::array kOnLight = {0x0072b2U, 0xd55e00U, 0x00805cU,
                                   0xb85590U, 0x8f6200U, 0x2f3337U};
  constexpr std::array kOnDark = {0x56b4e9U, 0xe69f00U, 0x2fc79bU, 0xe39ac4U, 0xf0e442U, 0xe6e6e6U};
  constexpr std::array<int, 5> kMarkers = {vtkPlotPoints::CIRCLE, vtkPlotPoints::SQUARE,
                                           vtkPlotPoints::DIAMOND, vtkPlotPoints::CROSS,
                                           vtkPlotPoints::PLUS};
  const auto& colors = theme::is_dark(palette) ? kOnDark : kOnLight;
  return {QColor(QRgb(colors[series % colors.size()])), kMarkers[series % kMarkers.size()]};
}

}  // namespace episcope
