// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/session/sweep/sweep.h"
#include "app/session/sweep/sweep_table.h"
#include "widgets/plot/line_plot.h"

#include <QString>
#include <QStringList>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace episcope {

/// What is run, copied when it is begun, and the points that are there.
struct Sweep {
  std::uint64_t number = 0;  ///< Tells sweeps apart.
  std::uint64_t scene = 0;
  std::string scene_name;
  bool has_truth = false;
  EstimateRequest base;
  std::vector<SweptParameter> swept;
  std::vector<ParameterSet> planned;
  std::vector<SweepPoint> points;
  std::vector<SweepLine> lines;  ///< Of the points.
};

/// "smoothing λ [px]": a parameter as the user reads it.
[[nodiscard]] QString axis_text(const ParameterDescription& description);

/// What can be plotted, with units; nothing that needs ground truth if there is none.
[[nodiscard]] QStringList measure_names(const Sweep& sweep);
/// A measure, by its place in these names, over the first parameter.
[[nodiscard]] Plot plot_of(const Sweep& sweep, int measure);
/// Where a point is in such a plot; none for the present values beside the grid.
[[nodiscard]] std::optional<PlotPlace> place_of(const Sweep& sweep, std::size_t point);

/// "EPI_L, lambda 0.2"
[[nodiscard]] std::string name_of(const Sweep& sweep, const SweepPoint& point);
/// The same with its numbers, or what went wrong.
[[nodiscard]] QString text_of(const Sweep& sweep, const SweepPoint& point);

}  // namespace episcope
