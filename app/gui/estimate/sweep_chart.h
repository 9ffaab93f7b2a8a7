// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/sweep.h"
#include "widgets/controls/line_plot.h"

#include <QString>
#include <QStringList>

#include <cstddef>
#include <optional>
#include <vector>

namespace episcope {

/// Plot of a sweep, and the sweep point of each plot point.
struct SweepChart {
  /// The mean of all light fields has no place.
  struct Place {
    std::optional<std::size_t> scene;  ///< Index among the sweep's scenes.
    std::size_t point = 0;             ///< Index of the point.
  };
  Plot plot;
  std::vector<std::vector<Place>> places;  ///< By series and point.
};

/// Axis title of a parameter: "smoothing λ [px]".
[[nodiscard]] QString axis_text(const ParameterDescription& description);

/// Names of plottable measures, with units; without ground truth, none that need it. Before the
/// first point, `expects_truth` tells whether there is some.
[[nodiscard]] QStringList measure_names(const Sweep& sweep, bool expects_truth);
/// Choices of light fields: all together first, then each. Empty if there is only one.
[[nodiscard]] QStringList scene_choices(const Sweep& sweep);
/// Plots measure number `measure` over the first parameter, for choice number `scene`. The choice
/// "all" has one line per light field and their mean; with a second parameter, only lines of the
/// mean.
[[nodiscard]] SweepChart chart_of(const Sweep& sweep, int measure, int choice);
/// Plot place of a sweep point, or of the mean that it counts in; none for values off the grid.
[[nodiscard]] std::optional<PlotPlace> place_in(const SweepChart& chart, SweepPlace point);

/// "EPI_L, inner_scale · 3 light fields"
[[nodiscard]] QString title_of(const Sweep& sweep);
/// "EPI_L, lambda 0.2"
[[nodiscard]] QString name_of(const Sweep& sweep, const SweepPoint& point);
/// Name and scores of a point, or its failure; with the light field if there are several.
[[nodiscard]] QString text_of(const Sweep& sweep, SweepPlace point);

}  // namespace episcope
