// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/sweep/sweep_list.h"
#include "app/session/sweep/sweep_table.h"
#include "widgets/plot/line_plot.h"

#include <QString>
#include <QStringList>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// A plot of a sweep, with what its points are.
struct SweepChart {
  /// The mean of all light fields is of none.
  struct Place {
    std::optional<std::size_t> scene;  ///< Among those of the sweep.
    std::size_t point = 0;             ///< Of that scene, or of every one.
  };
  Plot plot;
  std::vector<std::vector<Place>> places;  ///< By series and point.
};

/// "smoothing λ [px]": a parameter as the user reads it.
[[nodiscard]] QString axis_text(const ParameterDescription& description);

/// What can be plotted, with units; nothing that needs ground truth if there is none.
[[nodiscard]] QStringList measure_names(const Sweep& sweep);
/// Of which light fields: all together first, then each. Empty if there is only one.
[[nodiscard]] QStringList scene_choices(const Sweep& sweep);
/// A measure, by its place in these names, over the first parameter, for a choice by its place.
/// All together are a line for each and their mean; with a second parameter, lines of the mean.
[[nodiscard]] SweepChart chart_of(const Sweep& sweep, int measure, int choice);
/// Where a point is in such a plot, or the mean that it counts in; none for the present values
/// beside the grid.
[[nodiscard]] std::optional<PlotPlace> place_in(const SweepChart& chart, SweepPlace point);

/// "EPI_L, inner_scale · 3 light fields"
[[nodiscard]] QString title_of(const Sweep& sweep);
/// "EPI_L, lambda 0.2"
[[nodiscard]] std::string name_of(const Sweep& sweep, const SweepPoint& point);
/// The same with its numbers, or what went wrong; with the light field if there are several.
[[nodiscard]] QString text_of(const Sweep& sweep, SweepPlace point);

}  // namespace episcope
